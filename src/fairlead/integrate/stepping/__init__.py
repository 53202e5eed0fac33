"""The engine `stepping`: the zones of the end of a step are found with it. docs/stepping.md is its page."""
