"""What contact points take over from those that they continue: gap, slip, history. No search."""
