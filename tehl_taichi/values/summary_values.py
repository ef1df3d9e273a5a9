"""Values and error bars in summaries (nested dictionaries)."""


def value_at(summary, *keys):
    """Value in a summary by its nested keys; None if it is missing or if there is no summary."""
    for key in keys:
        summary = (summary or {}).get(key)
    return summary


def error_of(summary, *keys):
    """Error bar of a value in a summary by its nested keys; None if it is not known."""
    return value_at(summary, *keys[:-1], "error", keys[-1])
