"""Pages about a component type: what it connects and takes, its zones and its equations, as they are traced."""
