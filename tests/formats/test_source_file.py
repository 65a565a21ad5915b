import hashlib

import pytest

from towtank.core.errors import ReadError
from towtank.formats.source_file import SourceFile


def test_reads_bytes_and_their_digest(tmp_path):
    path = tmp_path / "run.csv"
    path.write_bytes(b"t;Fx\n0;1\n")
    source = SourceFile.read(path)
    assert source.data == b"t;Fx\n0;1\n"
    assert source.sha256 == hashlib.sha256(b"t;Fx\n0;1\n").hexdigest()
    assert source.path == str(path)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(ReadError, match=r"run7.csv: file not found ->"):
        SourceFile.read(tmp_path / "run7.csv")


def test_folder_is_refused(tmp_path):
    with pytest.raises(ReadError, match="is a folder"):
        SourceFile.read(tmp_path)


def test_empty_file_is_refused(tmp_path):
    (tmp_path / "empty.dat").touch()
    with pytest.raises(ReadError, match=r"empty.dat: the file is empty ->"):
        SourceFile.read(tmp_path / "empty.dat")
