//! Note of the constants with which a part ran, where they are not the defaults.

use maud::{Markup, html};
use teeter_dissertation::jenga3d::{Constants, TABLE};

use super::part::Usage;

/// Returns a paragraph that lists the constants of a part that differ from the defaults; nothing
/// where none does, or where the part uses none.
pub fn note(constants: &Constants, usage: Usage) -> Markup {
    let varied = match usage {
        Usage::Nothing => return html! {},
        Usage::All => &[],
        Usage::Varies(names) => names,
    };
    let differing: Vec<String> = TABLE
        .iter()
        .filter(|constant| constant.value(constants) != constant.default())
        .map(|constant| {
            let unit = if constant.unit.is_empty() { String::new() } else { format!(" {}", constant.unit) };
            let compared = if varied.contains(&constant.name) { "; varied in this part" } else { "" };
            let (name, value, default) = (constant.name, constant.value(constants), constant.default());
            format!("{name} = {value}{unit} (default {default}{compared})")
        })
        .collect();
    html! {
        @if !differing.is_empty() {
            p class="constants" { "With constants other than the defaults: " (differing.join(", ")) "." }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_constants_that_differ_are_named() {
        assert_eq!(note(&Constants::default(), Usage::All).into_string(), "");
        let soft = Constants { stiffness: 5e3, static_friction: Some(0.5), ..Constants::default() };
        let text = note(&soft, Usage::Varies(&["stiffness"])).into_string();
        let stiffness = "stiffness = 5000 N/m (default 10000; varied in this part)";
        let expected = format!("other than the defaults: {stiffness}, static_friction = 0.5 (default none).");
        assert!(text.contains(&expected), "{text}");
        assert_eq!(note(&soft, Usage::Nothing).into_string(), "");
    }
}
