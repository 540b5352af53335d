"""Criteria of mixed-mode growth: which way a crack kinks, and how near it is to growing."""
