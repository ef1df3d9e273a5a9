"""Cams and followers: a table of radius, load and speeds over the cycle; a line contact and a run at each angle.

`cam_table` reads the table, `cam_run` runs it, `stored_cam` is the folder with table and figure, `cam_columns` and `cam_figure`
define columns and panels.
"""

from tehl_taichi.runs.cam.cam_run import cam
from tehl_taichi.runs.cam.stored_cam import Cam

__all__ = ["Cam", "cam"]
