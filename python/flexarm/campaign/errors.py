"""What a user can put right."""


class CampaignError(ValueError):
    """A fault of a campaign file, of an option or of a folder, as one line for the user."""
