"""The states on which a claim is asked to hold."""
