//! Text that is safe to display.

/// Maximum number of characters that a message repeats of a value.
const MAX_SHOWN: usize = 60;

/// Returns a text without characters that change a terminal or hide: control characters, marks of
/// direction and characters without width. A space replaces each of them.
///
/// Names of scenes that come from a file are printable, and so is all that an error repeats of one.
///
/// ```
/// assert_eq!(teeter_scene::printable("a\u{1b}[31mb\u{202e}c"), "a [31mb c");
/// ```
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if is_hidden(c) { ' ' } else { c }).collect()
}

/// Returns JSON with the characters that [`printable`] replaces written as escapes, which mean the
/// same. In JSON they can only be a part of texts.
///
/// ```
/// assert_eq!(teeter_scene::printable_json("{\"a\":\"\u{202e}\u{9b}\"}"), r#"{"a":"\u202e\u009b"}"#);
/// ```
pub fn printable_json(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        // All of them are below 0x10000, where an escape is one code unit.
        if is_hidden(c) { text.push_str(&format!("\\u{:04x}", u32::from(c))) } else { text.push(c) }
    }
    text
}

/// Returns the first characters of a text, printable, with an ellipsis where there are more.
///
/// ```
/// assert_eq!(teeter_scene::printable_start("a\u{7}bcd", 3), "a b…");
/// ```
pub fn printable_start(text: &str, max_chars: usize) -> String {
    let mut start: String = text.chars().take(max_chars).collect();
    if start.len() < text.len() {
        start.push('…');
    }
    printable(&start)
}

/// Printable text of limited length, for a message.
pub(crate) fn shown(text: &str) -> String {
    printable_start(text, MAX_SHOWN)
}

/// Returns true for a character that [`printable`] replaces.
///
/// ```
/// assert!(teeter_scene::is_hidden('\u{202e}') && !teeter_scene::is_hidden('é'));
/// ```
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
}
