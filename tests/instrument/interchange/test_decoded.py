"""Text in any of the encodings that programs write."""

import pytest

from instrument.errors import BadInput
from instrument.interchange.decoded import decoded

TEXT = "Beschleunigung [m/s²]\t20 °C, 3 µm\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252", "latin-1"])
def test_a_text_is_the_same_in_any_encoding(tmp_path, encoding):
    (tmp_path / "a.txt").write_bytes(TEXT.encode(encoding))
    assert decoded(tmp_path / "a.txt") == TEXT


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "empty"),
        (b" \n", "empty"),
        (b"a\0b", "NUL"),
        (b"\xff\xfea", "not utf-16"),
        (b"\xef\xbb\xbf\xff", "not utf-8"),
    ],
)
def test_what_is_no_text_is_refused(tmp_path, content, said):
    (tmp_path / "a.txt").write_bytes(content)
    with pytest.raises(BadInput, match=said):
        decoded(tmp_path / "a.txt")
