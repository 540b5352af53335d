"""Supports and tied interfaces: an interface, and one of the methods that hold it.

A support is an interface with the ground. No contact.
"""
