"""Named physical systems with a known answer: one module each, closed form and source included.

Every module is a page of physics that can be read alone: what the system is, why it behaves as it
does, and a function that returns the exact answer. Nothing here imports fairlead, so a test that
compares the two compares two independent statements of the same physics. The closed forms are
themselves checked against quadrature and numerical integration in `tests/unit/test_reference_*.py`.

In order of reading:

=====================  ==================================================================
`stopping`             a block sliding to rest on a floor
`incline`              a block on a slope: when it holds, how it slides
`carried`              a block dropped on a moving belt
`belt`                 a block on a belt, held by a spring: stick-slip
`creep`                how a very viscous contact imitates sticking: creep, leak, breakaway
`hump`                 a sliding law that first rises, then falls; stability of sliding
`capstan`              a rope round a bend, continuous and cut into elements
`double_capstan`       a core in a hose round a bend; which of the two contacts slips
`rod_anchor`           a rod held along its length by friction: how far a pull reaches
`elastic_rod`          wave speed and natural frequencies of a rod and of its chain of masses
`hanging_line`         tension and stretch of a line with a load along its length
`window`               the trapezoid window through which a device sees a travelling chain
`sandwich`             two contacts in series, stepped through by Moreau's method: no zones, no events
=====================  ==================================================================
"""
