"""Kinds of campaigns of the tests, outside of flexarm as a user's would be."""
