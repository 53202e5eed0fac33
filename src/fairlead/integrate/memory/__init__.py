"""The memory of a run: a struct for each owner, the arena that they lie in, and how compiled code sees it."""
