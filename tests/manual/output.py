"""Whether a command printed what its page says."""

import re

# Numbers of a page are rounded, and the last digit depends on compiler and processor: they agree
# to one in a thousand, or of three digits or more to one of the last. Of a number that is noise
# around zero only the page's "…" is right.
RELATIVE_TOLERANCE = 1e-3
FEWEST_DIGITS = 3

_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


def _last_digit(number: str) -> float:
    """One of the last digit of a number of FEWEST_DIGITS or more, else 0."""
    mantissa, _, exponent = number.lstrip("+-").partition("e")
    whole, _, decimals = mantissa.partition(".")
    if len((whole + decimals).lstrip("0")) < FEWEST_DIGITS:
        return 0.0
    return 10.0 ** (int(exponent or 0) - len(decimals))


def _same_numbers(expected: str, printed: str) -> bool:
    a, b = float(expected), float(printed)
    tolerance = max(RELATIVE_TOLERANCE * max(abs(a), abs(b)), 1.000001 * _last_digit(expected))
    return abs(a - b) <= tolerance


def _same_plain(expected: str, printed: str) -> bool:
    """Text between numbers word for word, whatever the spaces: columns move with their numbers."""
    words = [re.sub(r"\s+|-{4,}", " ", text).strip() for text in _NUMBER.split(expected)]
    printed_words = [re.sub(r"\s+|-{4,}", " ", text).strip() for text in _NUMBER.split(printed)]
    if words != printed_words:
        return False
    return all(map(_same_numbers, _NUMBER.findall(expected), _NUMBER.findall(printed)))


def _same_line(expected: str, printed: str) -> bool:
    if "…" not in expected:
        return _same_plain(expected, printed)
    head, tail = expected.split("…", 1)
    # Any text in its place: the shortest head and tail that fit decide.
    return any(
        _same_plain(head, printed[:begin]) and any(
            _same_line(tail, printed[end:]) for end in range(begin, len(printed) + 1))
        for begin in range(len(printed) + 1))


def first_difference(expected: list[str], printed: list[str]) -> str | None:
    """Nothing where they agree, else a sentence."""
    expected = [line.rstrip() for line in expected]
    printed = [line.rstrip() for line in printed]
    while printed and not printed[-1]:
        printed.pop()
    while expected and not expected[-1]:
        expected.pop()
    at = 0
    open_end = False
    for line in expected:
        if line == "...":
            open_end = True
            continue
        if open_end:
            while at < len(printed) and not _same_line(line, printed[at]):
                at += 1
            open_end = False
        if at == len(printed):
            return f"not printed: {line!r}"
        if not _same_line(line, printed[at]):
            return f"page: {line!r}; printed: {printed[at]!r}"
        at += 1
    if at < len(printed) and not open_end:
        return f"printed beyond the page: {printed[at]!r}"
    return None


def numbers_in(text: str) -> list[float]:
    return [float(number) for number in _NUMBER.findall(text)]


def is_rounded_from(text: str, values: list[float]) -> bool:
    """Whether a number as written in prose is one of `values`, rounded to its digits."""
    number = float(text)
    digits = len(text.split(".")[1]) if "." in text else 0
    unit = 10.0**-digits
    return any(abs(number - abs(value)) <= 0.5000001 * unit or number == value for value in values)
