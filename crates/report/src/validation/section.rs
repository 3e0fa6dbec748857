//! Section of the report: figures, tables, charts and data of a topic.

use maud::{Markup, html};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::chart::Chart;
use crate::page::PageSection;
use crate::table::Table;

/// Measured figure.
#[derive(Debug, Clone, Serialize)]
pub struct Figure {
    /// Quantity.
    pub what: String,
    /// Value with its unit.
    pub value: String,
    /// Goal; none for a figure that only informs.
    pub goal: Option<String>,
    /// True when the goal is met; none without a goal.
    pub met: Option<bool>,
}

/// Section of the report.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// Short name, for links and selection.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Method of measurement.
    pub method: String,
    /// Figures.
    pub figures: Vec<Figure>,
    /// Figures as numbers with a name, for programs; not finite where nothing was measured.
    pub numbers: Vec<(String, f64)>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Charts.
    pub charts: Vec<Chart>,
    /// Measurements as data.
    pub data: Value,
}

impl Section {
    /// Section without content.
    pub fn new(name: &'static str, title: &'static str, method: impl Into<String>) -> Self {
        Self { name, title, method: method.into(), ..Self::default() }
    }

    /// Adds a figure that only informs.
    pub fn inform(&mut self, what: impl Into<String>, value: impl Into<String>) {
        self.figures.push(Figure { what: what.into(), value: value.into(), goal: None, met: None });
    }

    /// Adds a figure with a goal.
    pub fn goal(&mut self, what: impl Into<String>, value: impl Into<String>, goal: impl Into<String>, met: bool) {
        self.figures.push(Figure { what: what.into(), value: value.into(), goal: Some(goal.into()), met: Some(met) });
    }

    /// Adds a figure as a number for programs; its name ends with its unit.
    pub fn number(&mut self, name: impl Into<String>, value: f64) {
        self.numbers.push((name.into(), value));
    }

    /// Returns true if every figure with a goal meets it.
    pub fn is_met(&self) -> bool {
        self.figures.iter().all(|figure| figure.met != Some(false))
    }

    /// Returns the numbers as an object, null where a number is not finite.
    pub fn numbers_json(&self) -> Value {
        self.numbers.iter().map(|(name, value)| (name.clone(), json!(value))).collect::<Map<_, _>>().into()
    }

    /// Adds a table.
    pub fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        self.tables.push(Table::new(head.iter().copied(), rows));
    }

    /// Returns the section as data, without its charts.
    pub fn json(&self) -> Value {
        json!({
            "name": self.name,
            "title": self.title,
            "figures": self.figures,
            "numbers": self.numbers_json(),
            "tables": self.tables,
            "data": self.data,
        })
    }

    /// Returns the section of the page.
    pub fn html(&self) -> PageSection {
        let content = html! {
            p { (self.method) }
            table.words {
                @for figure in &self.figures { tr { td { (figure.what) } td class=[result(figure)] { (figure.value) } } }
            }
            div.charts { @for chart in &self.charts { (chart) } }
            @for table in self.tables.iter().filter(|table| !table.rows.is_empty()) { (table) }
        };
        PageSection::new(self.name, self.title, content)
    }

    /// Rows of the summary: each figure with a goal, linked to its section.
    pub fn summary(&self) -> Markup {
        html! {
            @for figure in self.figures.iter().filter(|figure| figure.met.is_some()) {
                tr {
                    td { a href={ "#" (self.name) } { (figure.what) } }
                    td { (figure.value) }
                    td { (figure.goal.as_deref().unwrap_or_default()) }
                    td class=[result(figure)] { (result(figure).unwrap_or_default()) }
                }
            }
        }
    }
}

/// Result of a figure with a goal, also its class in the style sheet.
fn result(figure: &Figure) -> Option<&'static str> {
    figure.met.map(|met| if met { "met" } else { "missed" })
}
