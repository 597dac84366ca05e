"""What a figure says to who does not see it."""

from matplotlib.figure import Figure

from instrument.report.picture import in_words


def test_axes_how_far_they_go_and_what_is_drawn_are_said():
    figure = Figure()
    left, right = figure.subplots(1, 2)
    left.plot([10, 20], [0, 3], label="measured")
    left.set(
        xlabel="Frequency / Hz", ylabel="Velocity / (m/s)", xlim=(10, 20), ylim=(0, 3), title="Segment 1"
    )
    right.plot([1, 2], [1, 2], label="_helper")
    right.set_axis_off()
    assert in_words(figure) == (
        "Segment 1: Velocity / (m/s) from 0 to 3 over Frequency / Hz from 10 to 20. Drawn: measured"
    )


def test_a_drawing_says_what_is_written_in_it_and_of_many_names_the_first():
    figure = Figure()
    ax = figure.subplots()
    ax.set_axis_off()
    assert in_words(figure) == "A drawing"
    for k in range(8):
        ax.text(0, 0, f"spot\n{k}")
    assert in_words(figure) == "A drawing with: spot 0, spot 1, spot 2, spot 3, spot 4, spot 5 and 2 more"
