"""Fourth stage of the pipeline: the flat model as arrays, kernels and callbacks for an engine."""
