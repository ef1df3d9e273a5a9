"""Values of scenes and entries: declared once with default, unit, meaning and range (`quantity`), checked, printed.

`checks` refuses values out of range, `coerce` turns numpy values into Python ones, `registry` collects entries of a folder.
`coded_warning` is a warning with a code, `escape` makes text safe for each kind of output.
May import: errors.
"""
