"""What the system says of a file that it did not take."""

import errno
import os

import pytest

from instrument.errors import BadInput, is_full, system_words
from instrument.files.at_once import write_at_once


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "a.h5"), "disk full"),
        (OSError(errno.EFBIG, os.strerror(errno.EFBIG)), "File too large"),
        (OSError(errno.ENOSPC, "Can't write data (file write failed: time = Mon, errno = 28)"), "disk full"),
        (
            OSError(errno.ENOSPC, "disk full: 1 MB free, 2 MB needed for a.h5"),
            "disk full: 1 MB free, 2 MB needed",
        ),
        (OSError(errno.EACCES, os.strerror(errno.EACCES), "a.h5"), "Permission denied"),
        (OSError("a library's own"), "a library's own"),
    ],
)
def test_a_full_disk_is_said_plainly_and_no_number_of_an_error(error, said):
    assert system_words(error).startswith(said)
    assert "Errno" not in system_words(error)


@pytest.mark.parametrize(
    ("number", "full"), [(errno.EFBIG, True), (errno.EDQUOT, True), (errno.EACCES, False)]
)
def test_room_is_to_be_made_where_the_disk_or_a_share_of_it_is_full(number, full):
    assert is_full(OSError(number, "")) is full


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device of Linux")
def test_it_is_said_with_the_file(tmp_path):
    (tmp_path / "out.json").symlink_to("/dev/full")
    with pytest.raises(BadInput, match=r"out\.json: disk full$"):
        write_at_once(tmp_path / "out.json", "x" * 100_000)
