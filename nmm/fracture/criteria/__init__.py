"""Mixed-mode criteria: the kink angle of a crack, and its equivalent stress intensity factor."""
