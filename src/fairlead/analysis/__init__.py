"""Fifth stage of the pipeline: what a model or a run tells beyond its signals.

    treatments   how a scene is told to treat friction, and which scenes `stepping` may take
    record       what `run.json` holds of a run: events, extremes, limits, counts, energy, creep
    statics      forces and shapes that follow without a run: laid routes, profiles, cones
    margins      how near a run came to the limits of its line
    remarks      what a user should know of the scene or the run
    cost         what an accuracy or a mesh costs in time, and what it buys
    effects      what each effect that a scene can switch off does to its outputs

A room imports those before it in this list only (tests/unit/test_import_direction.py). `characteristic.py` is the curve
of one friction law, measured on the law alone.
"""
