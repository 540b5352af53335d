"""Error against seconds: cost studies, their report, orders, and the cost model."""
