"""The engine `rodas`: Rosenbrock methods, every switch located."""
