"""The sheet of pictures, the JSON and the table of a corpus."""
import collections
import html
import json
import re

VERDICTS = ("rendered", "black", "refused", "failed", "crash", "hang")

PAGE = """<!doctype html>
<meta charset="utf-8">
<title>Corpus</title>
<style>
body {{ font: 14px sans-serif; margin: 1em; }}
main {{ display: flex; flex-wrap: wrap; gap: 8px; }}
figure {{ width: 160px; margin: 0; overflow-wrap: anywhere; }}
figure img, figure b {{ display: block; width: 160px; height: 120px; background: #ddd; }}
figure b {{ display: grid; place-items: center; }}
figcaption small {{ display: block; color: #555; }}
.rendered b {{ color: #070; }} .black, .refused {{ color: #850; }} .failed, .crash, .hang {{ color: #a00; }}
</style>
<pre>{table}</pre>
<main>
{figures}
</main>
"""


def reason(message):
    """A message without what differs from file to file: where, numbers, and names in quotes."""
    what = re.sub(r" \([^()]*\): [^()]*$", "", message)
    return re.sub(r"\d[\d.e+-]*", "N", re.sub(r"'[^']*'", "'…'", what))


def counts(results):
    """How many files came to each verdict; all verdicts, in order."""
    found = collections.Counter(result["verdict"] for result in results)
    return {verdict: found[verdict] for verdict in VERDICTS}


def reasons(results):
    """Reasons of refusal, the most frequent first, one a line."""
    found = collections.Counter(reason(result["message"]) for result in results if result["message"])
    return [f"{number:>5}  {text}" for text, number in found.most_common()]


def by_report(results):
    """What came of files that the validator's reports know, of those without errors and with; why of the former."""
    known = [result for result in results if result.get("errors") is not None]
    lines = []
    for title, group in (("valid", [result for result in known if result["errors"] == 0]),
                         ("with errors", [result for result in known if result["errors"] > 0])):
        words = ", ".join(f"{number} {verdict}" for verdict, number in counts(group).items() if number)
        if group:
            lines += ["", f"{title} by their reports: {len(group)} ({words})"]
        if title == "valid":
            lines += reasons(group)
    return lines


def summary(results):
    """A table as text: verdicts, then reasons of refusal and kinds of warning, the most frequent first."""
    lines = [f"{verdict:<10} {number:>5}  {100 * number / len(results):5.1f} %" for verdict, number in counts(results).items()]
    lines.append(f"{'files':<10} {len(results):>5}")
    warnings = collections.Counter(reason(re.sub(r"^\S+: ", "", text)) for result in results
                                   for text in result["warnings"])
    lines += ["", "reasons", *reasons(results), *by_report(results), "", "warnings"]
    lines += [f"{number:>5}  {text}" for text, number in warnings.most_common()]
    return "\n".join(lines)


def figure(result):
    """A picture with what is to be said of it."""
    has_picture = result["verdict"] in ("rendered", "black")
    shown = f'<img src="{result["picture"]}" alt="">' if has_picture else f'<b>{result["verdict"]}</b>'
    words = [f'{result["verdict"]}, {result["seconds"]:.1f} s', result["message"], *result["warnings"]]
    notes = "".join(f"<small>{html.escape(text)}</small>" for text in words if text)
    return (f'<figure class="{result["verdict"]}">{shown}<figcaption>{html.escape(result["name"])}{notes}</figcaption>'
            "</figure>")


def write(folder, results):
    """index.html and corpus.json in `folder`."""
    data = {"counts": counts(results), "files": results}
    (folder / "corpus.json").write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n")
    figures = "\n".join(map(figure, results))
    (folder / "index.html").write_text(PAGE.format(table=html.escape(summary(results)), figures=figures))
