"""What the items of a list are called: by their `name`, else by their type, as the devices of a route are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable


def item_names(items: Iterable[tuple[str | None, str | None]]) -> list[str | None]:
    """Of (name, type): the name, else the type in small letters, with a number where there are several: bend_1, bend_2.

    None for an item that has neither.
    """
    items = list(items)
    words = [name or (type.lower() if type else None) for name, type in items]
    many = {word for word, count in Counter(words).items() if count > 1}
    seen: Counter[str | None] = Counter()
    made = []
    for (name, _), word in zip(items, words, strict=True):
        seen[word] += 1
        made.append(f"{word}_{seen[word]}" if word in many and name is None and word else word)
    return made
