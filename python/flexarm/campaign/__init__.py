"""Campaigns: many tasks on many processes or machines, by dask.distributed.

    python -m flexarm.campaign campaign.toml

    from flexarm.campaign import open_results
    open_results("campaign-results")

docs/campaign.md is the manual. The kinds of campaigns are modules of `flexarm.campaign.kinds`.
"""

from .errors import CampaignError
from .results import open_results

__all__ = ["CampaignError", "open_results"]
