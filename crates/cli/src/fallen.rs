//! Result of a run in words.

/// Maximum number of fallen blocks that are named in the text.
const MAX_NAMED: usize = 10;

/// Returns the result of a run of `count` blocks, of which those with the ids `fell` fell.
pub fn result(fell: &[u32], count: usize) -> String {
    match fell {
        [] => "stands".to_owned(),
        [id] => format!("block {id} fell"),
        ids if ids.len() == count => format!("all {count} blocks fell"),
        ids => {
            let named: Vec<String> = ids.iter().take(MAX_NAMED).map(u32::to_string).collect();
            let more = if ids.len() > MAX_NAMED { ", ..." } else { "" };
            format!("{} of {count} blocks fell: {}{more}", ids.len(), named.join(", "))
        }
    }
}
