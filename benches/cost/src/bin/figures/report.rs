//! Table of figures.

use std::fmt::Write;

use teeter_cost::COMPILER;

use crate::figure::{Figure, Goal};

const HEAD: &str = "\
| figure | goal | measured (quartiles of the rounds) | met | state |
|---|---|--:|---|---|";

/// Formats the table, the processor and the compilers as Markdown.
pub fn markdown(figures: &[Figure], rounds: usize) -> String {
    let mut text = format!("{HEAD}\n");
    for figure in figures {
        let unit = figure.unit;
        let goal = match figure.goal {
            Goal::None => String::new(),
            Goal::AtMost(max) => format!("at most {max}{unit}"),
            Goal::AtLeast(min) => format!("at least {min}{unit}"),
            Goal::About(about) => format!("{about}{unit}, give or take 5 %"),
        };
        let met = figure.goal.met(figure.value()).map_or("", |met| if met { "yes" } else { "no" });
        let [low, _, high] = figure.quartiles;
        let Figure { of, hash, .. } = figure;
        let (value, low, high) = (short(figure.value()), short(low), short(high));
        writeln!(text, "| {of} | {goal} | {value}{unit} ({low} to {high}) | {met} | {hash} |")
            .expect("writing to a string does not fail");
    }
    let node = std::process::Command::new("node").arg("--version").output();
    let node = node.map_or(String::new(), |output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    write!(text, "\n{}, {COMPILER}, node {node}, {rounds} rounds.", processor())
        .expect("writing to a string does not fail");
    text
}

/// Formats a number with three digits or a few more.
fn short(value: f64) -> String {
    if value < 10.0 { format!("{value:.3}") } else { format!("{value:.1}") }
}

/// Returns the name of the processor.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or("a processor without a name", |(_, name)| name.trim()).to_owned()
}

/// Replaces the part of `page` between the marks of this table; `None` without marks.
pub fn with_table(page: &str, table: &str) -> Option<String> {
    let (begin, end) = ("<!-- table: written by tools/figures -->\n", "<!-- end of table -->");
    let (head, rest) = page.split_once(begin)?;
    let (_, tail) = rest.split_once(end)?;
    Some(format!("{head}{begin}\n{}\n\n{end}{tail}", table.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_table_is_replaced() {
        let other = "<!-- table: written by another -->\n\nold\n\n<!-- end of table -->\n";
        let page =
            format!("{other}a\n<!-- table: written by tools/figures -->\nold\n<!-- end of table -->\nb\n{other}");
        let new = with_table(&page, "new\n").unwrap();
        assert_eq!(
            new,
            format!("{other}a\n<!-- table: written by tools/figures -->\n\nnew\n\n<!-- end of table -->\nb\n{other}")
        );
        assert_eq!(with_table(&new, "new\n").unwrap(), new);
        assert!(with_table(other, "new").is_none());
    }
}
