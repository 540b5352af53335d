"""What effects are given: the setup that they are built from, and what they are told of a step."""
