//! Memory that reading a large file takes. One test, so that no other allocates beside it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use teeter_scene::{MAX_BYTES, Scene};

/// Allocator that records the greatest sum of all allocations.
struct Peak;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

// SAFETY: passes every call on to the allocator of the system.
unsafe impl GlobalAlloc for Peak {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        PEAK.fetch_max(NOW.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        // SAFETY: as for this function.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as for this function.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Peak = Peak;

/// Returns the error of a text, and the greatest sum of allocations while it was read, bytes.
fn error_and_peak(text: &str) -> (String, usize) {
    let before = NOW.load(Relaxed);
    PEAK.store(before, Relaxed);
    let error = Scene::read(text.as_bytes(), MAX_BYTES).unwrap_err().to_string();
    (error, PEAK.load(Relaxed) - before)
}

/// Text of `length` bytes: a beginning, one part again and again, and an end.
fn repeated(start: &str, part: &str, end: &str, length: u64) -> String {
    let count = (length as usize - start.len() - end.len()) / part.len();
    [start, &part.repeat(count), end].concat()
}

#[test]
fn errors_in_files_of_the_maximum_size_are_located_in_200_megabytes() {
    let block = r#"{"id":0,"size":[1,1,1],"mass":1,"pos":[0,0,0]},"#;
    let list = r#"{"name":"a","friction":1,"blocks":["#;
    let cases = [
        // More blocks than a scene may have, and an error behind them.
        (repeated(list, block, "3]}", MAX_BYTES), "`blocks` is a list of 13"),
        // A block whose error is behind a long comment.
        (
            repeated(&format!("{list}{{\"comment\":\""), "abcdefgh", "\",\"mass\":\"a\",\"id\":77}]}", MAX_BYTES),
            "block 77: `mass` is the text \"a\", expected a number (line 1, column 63999",
        ),
        // Texts and names of fields that fill the file, with an escape that has to be decoded.
        (repeated("{\"name\":\"\\n", "abcdefgh", "\"}", MAX_BYTES), "`name` is the text \" abcdefgh"),
        (repeated("{\"\\n", "abcdefgh", "\":1}", MAX_BYTES), "` abcdefgh"),
        (repeated("{\"form\":\"\\n", "abcdefgh", "\"}", MAX_BYTES), "`form` is the text \" abcdefgh"),
        (repeated("{\"truth\":", "[", "", MAX_BYTES), "this is not JSON: the text ends inside a list"),
        (repeated("{\"blocks\":", "[", "", MAX_BYTES), "block at index 0 of the list is a list"),
        (repeated(list, "\n", "x", MAX_BYTES), "this is not JSON: "),
        (repeated("\n", " ", "", MAX_BYTES), "the scene is empty"),
        (repeated("{", " ", "", MAX_BYTES + 1), "the scene is larger than 64 MB"),
    ];
    for (text, expected) in cases {
        let (error, peak) = error_and_peak(&text);
        assert!(error.starts_with(expected), "{error}");
        assert!(error.len() < 400, "{}", error.len());
        assert!(peak < 200_000_000, "{} MB: {error}", peak / 1_000_000);
    }
}
