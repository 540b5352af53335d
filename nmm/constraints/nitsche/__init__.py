"""Interfaces held by Nitsche's method: its terms, and the matter whose tractions they know."""
