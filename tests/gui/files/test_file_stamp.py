"""A file that is written anew is another one."""

import os

from gui.files.file_stamp import stamp_of


def test_a_file_is_known_again_until_it_is_written(tmp_path):
    path = tmp_path / "data.csv"
    assert stamp_of(path) is None
    assert stamp_of(None) is None
    path.write_text("1\n")
    first = stamp_of(path)
    assert stamp_of(path) == first
    os.utime(path, ns=(0, first[0] + 1))
    assert stamp_of(path) != first
    path.write_text("1, 2\n")
    assert stamp_of(path)[1] != first[1]
