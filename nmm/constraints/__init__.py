"""Supports and tied interfaces: held or joined by springs, Nitsche's method or multipliers.

No contact.
"""
