"""Events: guards, where they fire, settlements, impacts, the order of release, consistent points. For all engines."""
