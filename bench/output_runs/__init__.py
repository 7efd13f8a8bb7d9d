"""The runs of bench/compare_outputs and their inputs."""
