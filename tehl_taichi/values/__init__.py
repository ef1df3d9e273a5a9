"""What a value is: declared once with default, unit, meaning and range; checked at the door; shown in sentences.

`quantity` declares, `checks` refuses, `plain` makes Python values of numpy's. Laws (`physics`) and scenes declare their values
with it. May import `errors`.
"""
