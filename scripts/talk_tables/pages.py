"""Tables in the documentation, between <!-- table NAME --> and <!-- end -->."""
import re


def filled(page, name, text):
    """The page with the table in its place; None where it has none."""
    mark = re.compile(rf"(<!-- table {re.escape(name)} -->\n).*?\n?(<!-- end -->)", re.S)
    return mark.sub(lambda found: f"{found[1]}\n{text}\n\n{found[2]}", page) if mark.search(page) else None


def fill_page(page, name, text):
    """Writes the table into a page, if that has its mark; whether it has."""
    new = filled(page.read_text(), name, text)
    if new is not None:
        page.write_text(new)
    return new is not None


def fill(folder, name, text):
    """Writes the table into the page of a folder that has its mark, and returns that page; None where none has."""
    return next((page for page in sorted(folder.glob("*.md")) if fill_page(page, name, text)), None)
