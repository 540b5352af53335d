"""What effects are given: the setup from which they are built, and the data of a step."""
