"""Surface features: shapes given by formulas (`shapes`, one file each) and measured height maps (`maps`).

`shape` is the base class of all shapes. A new file in `shapes` is a new value of `feature.shape`.
May import: what scene may import.
"""
