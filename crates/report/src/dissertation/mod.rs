//! `teeter dissertation`: the chapter of results of the 2003 dissertation, run again.

mod column;
mod disabled;
mod flat;
mod frame_rate;
mod moves;
mod page;
mod picture;
mod report;
mod requirements;
mod soft;
mod statics;
mod table_5_2;
mod work;

pub use report::write;

/// Names of the parts of the report, for `--only`.
pub fn part_names() -> Vec<&'static str> {
    report::PARTS.iter().map(|part| part.name).collect()
}
