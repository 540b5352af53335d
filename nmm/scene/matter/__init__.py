"""What blocks are made of, and what is between them: materials and interfaces of a scene."""
