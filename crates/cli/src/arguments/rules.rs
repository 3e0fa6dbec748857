//! Arguments that choose the rules of a game.

use clap::Args;
use teeter_game::{Rules, RulesError, Table};

/// Rules of a game.
#[derive(Debug, Args)]
pub struct RulesArguments {
    /// Table of rules: free, official, strict, friendly, dissertation, solo or throw-and-go.
    #[arg(long, default_value = "official", value_parser = table)]
    rules: Table,
    /// Number of players, 1 to 8. Solo and free play have one.
    #[arg(long, default_value_t = 2)]
    players: u32,
    /// Seed of the die, where the rules have one.
    #[arg(long, default_value_t = 0)]
    die: u64,
}

impl RulesArguments {
    /// Returns the rules.
    pub fn rules(&self) -> Result<Rules, RulesError> {
        let rules = Rules::of(self.rules, self.players);
        let rules = Rules { die: rules.die.map(|_| self.die), ..rules };
        rules.validate().map(|()| rules)
    }
}

/// Parses the name of a table.
fn table(name: &str) -> Result<Table, String> {
    serde_json::from_value(serde_json::Value::from(name)).map_err(|_| format!("expected one of {}", names()))
}

fn names() -> String {
    let name = |table: &Table| serde_json::to_value(table).ok().and_then(|value| value.as_str().map(str::to_owned));
    Table::ALL.iter().filter_map(name).collect::<Vec<_>>().join(", ")
}
