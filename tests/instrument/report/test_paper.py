"""The report on paper."""

from instrument.report.html import html_page


def test_a_printed_report_ends_with_room_for_notes_and_signatures_and_the_screen_does_not():
    page = html_page("A plate", [], [], signed=True)
    style, body = page.split("</style>")
    screen, paper = style.split("@media print")
    assert ".signed { display: none; }" in screen
    assert ".signed { display: block;" in paper
    assert body.index("measured by") < body.index("checked by") < body.index("</main>")
