"""Campaigns: many tasks on many processes or machines, by dask.distributed.

    python -m flexarm.campaign campaign.toml

docs/campaign.md is the manual. The kinds of campaigns are modules of `flexarm.campaign.kinds`.
"""

from .errors import CampaignError

__all__ = ["CampaignError"]
