"""Error against seconds: cost studies, their report, orders, and the cost model.

Single runs are measured in `cases`.
"""
