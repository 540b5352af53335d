"""Cohesive cracks inside bodies, through nets that know nothing of them."""
