"""Contact rows of bodies where they are half way through a step, be they one element or many."""
