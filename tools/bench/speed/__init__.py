"""What tools/bench/pareto is made of."""
