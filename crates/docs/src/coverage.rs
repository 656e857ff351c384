//! Which functions of CoppeliaSim's reference work here.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;

use super::approximated::difference;
use super::row::FunctionDoc;
use super::{Age, ReferenceRow, reference};
use script::pairs;

/// The table.
pub(super) fn text(functions: &[FunctionDoc]) -> String {
    let built: HashSet<&str> = functions.iter().map(FunctionDoc::member).collect();
    let rows: Vec<ReferenceRow> = reference()
        .filter(|row| !row.name.starts_with('_'))
        .collect();
    let counted: Vec<&ReferenceRow> = rows.iter().filter(|row| row.age != Age::Later).collect();
    let mut out = String::from(
        "# Coverage of the `sim` reference\n\nGenerated from the sources: `UPDATE=1 cargo test --test repository generated`. A function that is \
         missing exists all the same: it raises `not implemented in Swanilda: sim.name`. An approximated one does less than in \
         CoppeliaSim, or takes the call without effect. Functions that came after 4.10 are not counted.\n\n",
    );
    out.push_str(&tiers(&counted, &built));
    out.push_str("\n| function | category | status |\n|---|---|---|\n");
    for row in &rows {
        let status = status(row.name, &built).word();
        let note = match row.age {
            Age::Current => "",
            Age::Deprecated => ", deprecated",
            Age::Later => ", came after 4.10",
        };
        let how = difference(&format!("sim.{}", row.name))
            .map(|how| format!(": {how}"))
            .unwrap_or_default();
        let _ = writeln!(
            out,
            "| `sim.{}` | {} | {status}{note}{how} |",
            row.name, row.category
        );
    }
    out
}

/// State of a function of the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    Works,
    Approximated,
    Missing,
}

impl Status {
    fn word(self) -> &'static str {
        match self {
            Self::Works => "works",
            Self::Approximated => "approximated",
            Self::Missing => "missing",
        }
    }
}

/// State of a function; `built` are those that exist.
pub(super) fn status(name: &str, built: &HashSet<&str>) -> Status {
    match (built.contains(name), difference(&format!("sim.{name}"))) {
        (false, _) => Status::Missing,
        (true, None) => Status::Works,
        (true, Some(_)) => Status::Approximated,
    }
}

/// Counts by tier: how much published code needs a function.
fn tiers(rows: &[&ReferenceRow], built: &HashSet<&str>) -> String {
    const MEANING: [(&str, &str); 4] = [
        (
            "T1",
            "called in five or more public repositories, or by the default main script",
        ),
        (
            "T2",
            "called in two to four, or needed by the stock models and libraries",
        ),
        ("T3", "called in one, or documented"),
        ("T4", "deprecated without use, graphical, or removed"),
    ];
    let tier_of: BTreeMap<&str, &str> = pairs(api::TIERS).collect();
    let mut out =
        String::from("| tier | what it is | works | approximated | of |\n|---|---|---|---|---|\n");
    let mut line = |tier: &str, meaning: &str, of: &[&&ReferenceRow]| {
        let count = |wanted: Status| {
            of.iter()
                .filter(|row| status(row.name, built) == wanted)
                .count()
        };
        let _ = writeln!(
            out,
            "| {tier} | {meaning} | {} | {} | {} |",
            count(Status::Works),
            count(Status::Approximated),
            of.len()
        );
    };
    for (tier, meaning) in MEANING {
        let of: Vec<_> = rows
            .iter()
            .filter(|row| tier_of.get(row.name) == Some(&tier))
            .collect();
        line(tier, meaning, &of);
    }
    line("", "all", &rows.iter().collect::<Vec<_>>());
    out
}
