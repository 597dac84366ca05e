"""The report on paper."""

from instrument.report.html import html_page


def test_a_printed_report_ends_with_room_for_notes_and_signatures_and_the_screen_does_not():
    page = html_page("A plate", [], [], signed=True)
    style, body = page.split("</style>")
    screen, paper = style.split("@media print")
    assert ".signed { display: none; }" in screen
    assert ".signed { display: block;" in paper
    assert body.index("measured by") < body.index("checked by") < body.index("</main>")


def test_on_paper_words_and_heads_are_broken_where_a_screen_scrolls():
    screen, paper = html_page("A plate", [], []).split("</style>")[0].split("@media print")
    assert "white-space: nowrap; }\nth {" in screen
    assert "td.words { text-align: left; white-space: normal; min-width: 12rem;" in screen
    assert "th { white-space: normal; }" in paper
    assert "td.words { min-width: 0; }" in paper
