"""Traction laws of joints and contacts.

Springs and limits of contact points that follow from them are in `contact.laws`.
"""
