//! `teeter dissertation report`: the page is written, and holds what was asked for.

mod common;

use common::teeter;

#[test]
fn parts_of_the_report() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new").join("report");
    let done = teeter(&[
        "dissertation",
        "report",
        "--out",
        out.to_str().unwrap(),
        "--only",
        "table-5.2",
        "--only",
        "soft-springs",
    ]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert_eq!(done.out.trim_end(), out.join("index.html").display().to_string());
    // Twice 168 n (n - 1) for 18, 27 and 54 blocks: printed, and counted.
    for count in ["102816", "235872", "961632"] {
        assert!(page.matches(&format!("<td>{count}</td>")).count() >= 2, "{count}");
    }
    assert_eq!(page.matches("<h2>").count(), 2);
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 3);
}

#[test]
fn bad_input_ends_with_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let under_a_file = file.join("report");
    let done = teeter(&["dissertation", "report", "--out", under_a_file.to_str().unwrap()]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1));
    assert!(done.err.contains("this folder cannot be made"), "{}", done.err);
    let done = teeter(&["dissertation", "report", "--out", "x", "--only", "chapter-9"]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1), "{}", done.err);
    assert!(done.err.contains("chapter-9"));
    assert_eq!(teeter(&["dissertation", "report"]).code, 2);
}
