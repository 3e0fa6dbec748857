"""Studies: rows follow from the index alone, and a folder of results is whole or refused."""

import contextlib
import math
import shutil
import signal
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from study_samples import DIES, DROP, FAILS, NUMBER, STOPS, number, program

import teeter
from teeter import study
from teeter.study.__main__ import main
from teeter.study.extra import needed
from teeter.study.folder import Folder
from teeter.study.interval import Z95

pq = pytest.importorskip("pyarrow.parquet")

indices = st.integers(0, 2**63 - 1)


@given(indices, indices, indices)
def test_seeds_of_a_study_differ_and_follow_from_master_and_index(master, one, other):
    seed = study.seed_of(master, one)
    assert 0 <= seed < 2**63
    assert seed == study.seed_of(master, one)
    assert (seed == study.seed_of(master, other)) == (one == other)
    assert (seed == study.seed_of(other, one)) == (master == other)


def test_no_two_pairs_of_words_are_one_sequence():
    low, high = 5, 7
    pairs = [(low + (high << 32), 3), (low, high + (3 << 32)), (low, 3), (0, 0), (0, 1), (1, 0)]
    assert len({study.seed_of(*pair) for pair in pairs}) == len(pairs)


@given(st.integers(0, 10**9), st.lists(st.integers(0, 10**6), min_size=1, max_size=8))
def test_a_row_is_the_same_in_any_order(master, order):
    plan = study.Plan(NUMBER, master)
    rows = {index: plan.row(index) for index in order}
    again = study.Plan(NUMBER, master)
    assert all(again.row(index) == rows[index] for index in sorted(order))


def test_the_first_samples_are_balanced_over_the_sweep():
    plan = study.Plan(NUMBER, params={"a": [1, 2], "b": [0.1, 0.2, 0.3]})
    combinations = [tuple(plan.sample(i).params.values()) for i in range(12)]
    assert len(set(combinations[:6])) == 6
    assert combinations[:6] == combinations[6:]


class StopError(Exception):
    """End of a run in its middle."""


class StopsAfter(study.Serial):
    """Serial, until it has made a number of calls."""

    def __init__(self, calls):
        self.left = calls

    def result(self, handle):
        if self.left == 0:
            raise StopError
        self.left -= 1
        return super().result(handle)


@settings(max_examples=20, deadline=None)
@given(st.integers(1, 30), st.lists(st.tuples(st.integers(1, 9), st.integers(0, 4)), max_size=4), st.data())
def test_batches_and_restarts_after_any_prefix_give_the_same_table(tmp_path_factory, samples, runs, data):
    whole = study.run(NUMBER, samples=samples, seed=3, batch=samples)
    out = tmp_path_factory.mktemp("study")
    for batch, calls in runs:
        with contextlib.suppress(StopError):
            study.run(NUMBER, out, samples=samples, seed=3, batch=batch, executor=StopsAfter(calls))
        parts = sorted((out / "parts").iterdir())
        if parts and data.draw(st.booleans()):
            data.draw(st.sampled_from(parts)).unlink()
    again = study.run(NUMBER, out, samples=samples, seed=3)
    assert again.digest == whole.digest
    assert again.table.equals(whole.table)
    assert study.load(out, NUMBER).digest == whole.digest


def test_more_samples_extend_the_results(tmp_path):
    few = study.run(NUMBER, tmp_path, samples=7)
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "parts").iterdir()}
    more = study.run(NUMBER, tmp_path, samples=20)
    assert more.table.slice(0, 7).equals(few.table)
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
    assert study.run(NUMBER, tmp_path, samples=7).digest == few.digest


def test_a_table_keeps_bits_and_absent_values(tmp_path):
    result = study.run(DROP, tmp_path, samples=6, batch=2)
    plan = result.plan
    for i, row in enumerate(result.table.to_pylist()):
        assert list(row.values()) == plan.row(i)
    assert result.table["path"].null_count == 2
    assert set(result.table["friction"].to_pylist()) == {0.3, 0.5}
    other = study.run(DROP, samples=6, seed=1)
    assert other.digest != result.digest


def test_a_sample_that_fails_is_named_and_the_rows_before_it_stay(tmp_path):
    marker = str(tmp_path / "cured")
    arguments = {"samples": 12, "params": {"marker": marker}, "batch": 3}
    with pytest.raises(
        teeter.StudyError, match=r"sample 7 of study `fails` failed: SceneError: `blocks\[3\]"
    ) as caught:
        study.run(FAILS, tmp_path / "out", **arguments)
    assert isinstance(caught.value.__cause__, teeter.SceneError)
    assert "\n" not in str(caught.value)
    assert study.load(tmp_path / "out", FAILS).table.num_rows == 7
    Path(marker).touch()
    whole = study.run(FAILS, tmp_path / "out", **arguments)
    assert whole.digest == study.run(FAILS, **arguments).digest


class Counts(study.Serial):
    """Serial with three workers, which counts the calls that are out and those fetched at a time."""

    workers = 3

    def __init__(self):
        self.out, self.most = 0, 0

    def submit(self, function, *arguments):
        self.out += 1
        self.most = max(self.most, self.out)
        return super().submit(function, *arguments)

    def result(self, handle):
        self.out -= 1
        return super().result(handle)


def test_calls_do_not_pile_up():
    executor = Counts()
    study.run(NUMBER, samples=40, batch=1, executor=executor)
    assert executor.most == 6
    assert executor.out == 0


def test_a_bar_counts_the_samples(capfd):
    study.run(NUMBER, samples=9, progress=True)
    shown = capfd.readouterr().err
    assert "number: 100%" in shown
    assert "9/9" in shown
    study.run(NUMBER, samples=9)
    assert capfd.readouterr().err == ""


# Folders that are refused


def refused(out, *words, field="out", which=NUMBER, **arguments):
    """Asserts that a run names the folder and the words, and leaves all files as they are."""
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    with pytest.raises(teeter.StudyError) as caught:
        study.run(which, out, samples=8, **arguments)
    message = str(caught.value)
    assert str(out) in message
    assert all(word in message for word in words), message
    assert "\n" not in message
    assert caught.value.field == field
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


@pytest.fixture
def out(tmp_path):
    study.run(NUMBER, tmp_path, samples=8, batch=4)
    return tmp_path


def test_a_folder_of_another_study_is_refused(out):
    refused(out, "`study`", '"number"', '"drop"', field="study", which=DROP)
    refused(out, "`seed`", "0", "9", field="seed", seed=9)
    refused(out, "`params.b`", "0.5", "0.7", field="b", params={"b": 0.7})
    newer = study.Study("number", number, NUMBER.columns, NUMBER.params, version=2)
    refused(out, "`version`", "1", "2", field="version", which=newer)
    less = study.Study("number", number, {"x": "float"}, NUMBER.params)
    refused(out, "`columns.even`", field="even", which=less)


def test_a_folder_of_something_else_is_refused(out, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    (other / "thesis.tex").write_text("x")
    refused(other, "thesis.tex", "manifest.json")
    (out / "manifest.json").unlink()
    refused(out, "part-000000000000-000000000004.parquet", "manifest.json")
    file = other / "file"
    file.write_text("x")
    with pytest.raises(teeter.StudyError, match="cannot be written"):
        study.run(NUMBER, file, samples=1)


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": 1}', "\x00", '{"params": 3}'])
def test_a_damaged_manifest_is_refused(out, text):
    (out / "manifest.json").write_text(text)
    refused(out, "manifest.json", "damaged")
    with pytest.raises(teeter.StudyError, match="damaged"):
        study.load(out)


def test_a_folder_without_parts_has_no_rows(out):
    shutil.rmtree(out / "parts")
    assert study.load(out, NUMBER).table.num_rows == 0
    assert study.run(NUMBER, out, samples=8).table.num_rows == 8


def part_of(out, first=0):
    return out / "parts" / f"part-{first:012}-{first + 4:012}.parquet"


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_a_damaged_part_is_refused_or_has_the_same_values(out, data):
    path, whole = part_of(out), study.load(out, NUMBER)
    good = path.read_bytes()
    bad = bytearray(good)
    if data.draw(st.booleans()):
        del bad[data.draw(st.integers(0, len(bad) - 1)) :]
    else:
        bad[data.draw(st.integers(0, len(bad) - 1))] ^= data.draw(st.integers(1, 255))
    path.write_bytes(bytes(bad))
    error = attempt(study.run, NUMBER, out, samples=8)
    # Some bytes of the file's own statistics mean nothing to a reader.
    assert (str(path) in str(error)) if error else study.load(out, NUMBER).digest == whole.digest
    assert "\n" not in str(error)
    path.write_bytes(good)


def test_a_part_that_is_not_of_this_folder_is_refused(out, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    study.run(NUMBER, other, samples=8, batch=4, seed=1)
    good = part_of(out).read_bytes()
    part_of(out).write_bytes(part_of(other).read_bytes())
    refused(out, part_of(out).name, "another study")
    part_of(out).write_bytes(good)
    overlapping = part_of(out, 2)
    overlapping.write_bytes(good)
    refused(out, overlapping.name, "damaged")
    overlapping.unlink()
    (out / "parts" / "notes.txt").write_text("x")
    refused(out, "notes.txt", "no part")


def test_a_part_with_other_values_is_refused(out):
    table = pq.read_table(part_of(out))
    other = table.set_column(table.column_names.index("x"), "x", table["x"].combine_chunks().take([1, 0, 2, 3]))
    pq.write_table(other.cast(table.schema), part_of(out))
    refused(out, part_of(out).name, "digest")


def test_samples_in_two_parts_are_refused(out):
    plan = study.Plan(NUMBER)
    folder = Folder(out, plan)
    folder.append(2, [plan.row(i) for i in range(2, 5)])
    folder.close()
    refused(out, "part-000000000002-000000000005", "another part")


def test_files_that_were_not_finished_are_thrown_away(out):
    whole = study.load(out, NUMBER)
    part_of(out).rename(part_of(out).with_suffix(".unfinished"))
    again = study.run(NUMBER, out, samples=8)
    assert again.digest == whole.digest
    assert not list(out.rglob("*.unfinished"))


def test_a_folder_has_one_writer_at_a_time(out):
    folder = Folder(out, study.Plan(NUMBER))
    try:
        refused(out, "another run")
        (out / "parts" / "part-000000000008-000000000012.unfinished").write_text("x")
        assert study.load(out, NUMBER).table.num_rows == 8
    finally:
        folder.close()
    study.run(NUMBER, out, samples=9)


# Bad input


def attempt(function, *arguments, **named):
    """Calls a function and returns the exception that it raised, or None."""
    try:
        function(*arguments, **named)
    except teeter.StudyError as error:
        return error
    return None


anything = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=4), st.binary(max_size=3),
    st.lists(st.one_of(st.integers(), st.floats(), st.text(max_size=2), st.booleans()), max_size=4),
    st.sampled_from([np.float32(0.5), np.int64(3), np.array([1, 2]), math.nan, 2**64, object(), "a,b", "\ud800"]),
)  # fmt: skip


@settings(max_examples=150, deadline=None)
@given(
    st.sampled_from(["loose", NUMBER, "castle", None, 3]),
    st.dictionaries(st.sampled_from(["rows", "height_sd", "a", "b", "x", ""]), anything, max_size=2),
    st.dictionaries(
        st.sampled_from(["seed", "samples", "workers", "address", "batch", "executor"]), anything, max_size=2
    ),
)
def test_bad_input_raises_a_typed_exception(which, params, arguments):
    plain = {name: value for name, value in arguments.items() if name != "samples" or not isinstance(value, int)}
    plain = {name: value for name, value in plain.items() if name not in ("workers",) or not isinstance(value, int)}
    for error in (
        attempt(study.Plan, study.STUDIES.get(which, which) if isinstance(which, str) else which, 0, params),
        attempt(study.run, NUMBER, **{"samples": 2, **plain}),
    ):
        assert error is None or (error.field is not None and str(error) and "\n" not in str(error))


@pytest.mark.parametrize(
    "value, column",
    [
        ({"x": "a"}, "x"),
        ({"x": True}, "x"),
        ({"y": 1}, "y"),
        ({"x": [1.0]}, "x"),
        ({"even": 1}, "even"),
        (3, "measure"),
    ],
)
def test_a_wrong_row_is_refused_with_its_column(value, column):
    wrong = study.Study("wrong", lambda sample: value, {"x": "float", "even": "bool"})
    with pytest.raises(teeter.StudyError, match="sample 0") as caught:
        study.run(wrong, samples=1)
    assert caught.value.field == column


@pytest.mark.parametrize(
    "arguments, field",
    [
        (("A b", number, {"x": "int"}), "name"),
        (("a", None, {"x": "int"}), "measure"),
        (("a", number, {}), "columns"),
        (("a", number, {"x": "complex"}), "columns"),
        (("a", number, {"seed": "int"}), "columns"),
        (("a", number, {"x": "int"}, {"x": 1}), "columns"),
    ],
)
def test_a_study_that_makes_no_sense_is_refused(arguments, field):
    with pytest.raises(teeter.StudyError) as caught:
        study.Study(*arguments)
    assert caught.value.field == field


def test_a_package_that_is_absent_is_named_with_its_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(teeter.UnavailableError, match=r"`pyarrow` is not installed, .*teeter\[study\]") as caught:
        study.run(NUMBER, samples=1)
    assert caught.value.field == "pyarrow"
    with pytest.raises(teeter.UnavailableError, match="castle"):
        needed("castle_of_cards", "study")


# Intervals


@given(st.integers(1, 10**6), st.data())
def test_the_ends_of_wilsons_interval_solve_its_equation(tries, data):
    count = data.draw(st.integers(0, tries))
    low, high = study.wilson(count, tries)
    share = count / tries
    assert 0 <= low <= share <= high <= 1
    for end in (low, high):
        assert abs(share - end) == pytest.approx(Z95 * math.sqrt(end * (1 - end) / tries), rel=1e-6, abs=1e-9)
    other = study.wilson(tries - count, tries)
    assert (1 - high, 1 - low) == pytest.approx(other, abs=1e-12)


def test_intervals_of_few_samples_are_wide():
    assert study.wilson(0, 0) == (0.0, 1.0)
    assert study.wilson(0, 10)[1] == pytest.approx(0.2775, abs=1e-4)
    assert study.mean_interval([4.0]) == (-math.inf, math.inf)
    low, high = study.mean_interval([1.0, 2.0, 3.0])
    assert (low, high) == pytest.approx((2 - Z95 / math.sqrt(3), 2 + Z95 / math.sqrt(3)))
    with pytest.raises(teeter.StudyError, match="`count`"):
        study.wilson(3, 2)


def test_intervals_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(5)
    for chance in (0.03, 0.3, 0.5):
        counts = rng.binomial(60, chance, 4000)
        inside = [study.wilson(int(count), 60) for count in counts]
        share = np.mean([low <= chance <= high for low, high in inside])
        assert 0.92 < share < 0.99, chance


def test_a_summary_is_of_each_combination():
    result = study.run(NUMBER, samples=30)
    lines = result.summary()
    assert [line["a"] for line in lines] == [1, 2, 3]
    x = result.table["x"].to_numpy()
    for line, own in zip(lines, (x[0::3], x[1::3], x[2::3]), strict=True):
        assert line["samples"] == line["x_count"] == 10
        assert line["x"] == pytest.approx(own.mean())
        assert (line["x_low"], line["x_high"]) == pytest.approx(study.mean_interval(own))
        assert (line["even"], line["even_low"], line["even_high"]) == (0.5, *study.wilson(5, 10))


# The program


def test_the_program_runs_a_study_of_ones_own(tmp_path):
    figure = tmp_path / "number.svg"
    line = [
        "study_samples:NUMBER",
        "--out",
        tmp_path / "out",
        "--samples",
        12,
        "--set",
        "a=4,5",
        "--executor",
        "serial",
    ]
    done = program(*line, "--plot", figure, "--quiet")
    assert done.returncode == 0, done.stderr
    expected = study.run(NUMBER, samples=12, params={"a": [4, 5]})
    assert expected.digest[:16] in done.stdout
    assert "a=4: 6 samples" in done.stdout
    assert figure.read_text().startswith("<?xml")


@pytest.mark.parametrize(
    "line, words",
    [
        (["castle"], "there is no study 'castle'"),
        (["study_samples:drop"], "expected a Study"),
        (["absent_module:X"], "absent_module"),
        (["loose", "--set", "rows"], "`--set` is 'rows'"),
        (["loose", "--samples", "0"], "`samples` is 0"),
        (["loose", "--workers", "3"], "`workers` is 3"),
        (["study_samples:NUMBER", "--samples", "4", "--plot", "x.castle"], "cannot be drawn"),
    ],
)
def test_the_program_ends_with_a_line_on_the_error(line, words, tmp_path, capsys):
    assert main([*line, "--out", str(tmp_path / "out"), "--executor", "serial", "--quiet"]) == 2
    shown = capsys.readouterr().err
    assert shown.startswith("teeter: ") and words in shown and shown.count("\n") == 1


def test_a_study_that_is_stopped_says_how_it_goes_on(tmp_path, capsys):
    line = ["study_samples:STOPS", "--out", str(tmp_path), "--samples", "6", "--executor", "serial", "--batch", "1"]
    assert main([*line, "--quiet"]) == 130
    assert "the same command goes on" in capsys.readouterr().err
    assert study.load(tmp_path, STOPS).table["x"].to_pylist() == [0, 1, 2]


def test_a_study_that_was_killed_goes_on_from_what_is_there(tmp_path):
    out, params = tmp_path / "out", {"marker": str(tmp_path / "killed")}
    line = ["study_samples:DIES", "--executor=serial", "--out", out, "--samples=9", "--batch=2", "--quiet"]
    killed = program(*line, f"--set=marker={params['marker']}")
    assert killed.returncode == -signal.SIGKILL
    assert study.load(out, DIES).table["index"].to_pylist() == [0, 1, 2, 3]
    before = {path: path.stat().st_mtime_ns for path in (out / "parts").iterdir()}
    whole = study.run(DIES, out, samples=9, params=params)
    assert whole.digest == study.run(DIES, samples=9, params=params).digest
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
