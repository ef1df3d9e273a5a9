"""Kernels of an isothermal film for graphics cards: those of the parent folder, with one column of a block per job.

`kernels` are loops around the functions of the parent folder; `twins` names the kernel that each one replaces. `bending`
computes the film; `newton` keeps the vectors of a Newton step on the card. Imported only if a run uses a graphics card.
"""
