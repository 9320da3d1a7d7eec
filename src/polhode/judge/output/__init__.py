"""A review as a page, a report, hints, and messages for editors and repositories."""
