"""What reads snapshots only: surface stresses and fatigue."""
