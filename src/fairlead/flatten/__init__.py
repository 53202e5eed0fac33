"""Third stage of the pipeline: from instances to one flat graph of nodes, groups and links."""
