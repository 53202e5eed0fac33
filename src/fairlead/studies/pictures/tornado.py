"""How far a figure moves when one parameter goes from one end of its values to the other.

For each parameter the cases are put into bins by its value, and the mean of the figure is taken in each bin: what the
others do is averaged. The bar goes from the lowest to the highest of these means. In a grid the bins are the values.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fairlead.studies.pictures.rows import Rows

MOST_BINS, FEWEST_IN_A_BIN = 10, 5


@dataclass(frozen=True)
class Bar:
    """One parameter: lowest and highest mean of the figure over its values, and at which value."""

    parameter: str
    low: float
    high: float
    at_low: str
    at_high: str

    @property
    def width(self) -> float:
        """How far the figure moves."""
        return self.high - self.low


def tornado(rows: Rows, figure: str) -> list[Bar]:
    """Bars, the widest first; parameters of which no two values have a figure are left out."""
    frame = rows.finished[rows.finished[figure].notna()]
    found = []
    for name in rows.varied:
        values = frame[name]
        bins = max(min(MOST_BINS, len(frame) // FEWEST_IN_A_BIN), 2)
        in_grid = name in rows.heading["design"]["grid"]
        if name in rows.numbers and not in_grid and values.nunique() > MOST_BINS:
            ranks = values.rank(method="first").to_numpy() - 1
            places = np.minimum((ranks * bins / len(frame)).astype(int), bins - 1)
            labels = [rows.value(name, float(values[places == k].mean())) for k in range(bins)]
            means = [float(frame[figure][places == k].mean()) for k in range(bins)]
        else:
            grouped = frame.groupby(name)[figure].mean()
            labels = [rows.value(name, float(one) if name in rows.numbers else one) for one in grouped.index]
            means = grouped.tolist()
        if len(means) > 1:
            low, high = int(np.argmin(means)), int(np.argmax(means))
            found.append(Bar(name, means[low], means[high], labels[low], labels[high]))
    return sorted(found, key=lambda bar: -bar.width)
