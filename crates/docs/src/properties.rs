//! The table of properties: which there are, and what becomes of them here.

use std::fmt::Write as _;

use script::property_table::{described, flags, later_names};

/// Parts in the order of the page, with what they belong to.
const PARTS: [(&str, &str); 27] = [
    ("app", "The application, `sim.handle_app`"),
    ("simulation", "The scene, `sim.handle_scene`: simulation"),
    ("environment", "The scene: environment"),
    ("container", "The scene: objects"),
    ("dynamics", "The scene: dynamics"),
    ("object", "All objects"),
    ("colour", "Objects with a colour"),
    ("shape", "Shapes"),
    ("mass", "Shapes: mass"),
    ("material", "Shapes: material"),
    ("mesh", "Meshes of shapes"),
    ("joint", "Joints"),
    ("dummy", "Dummies"),
    ("script", "Scripts"),
    ("scriptObject", "Scripts that are objects"),
    ("proximitySensor", "Proximity sensors"),
    ("volume", "Proximity sensors: volume"),
    ("rayColour", "Proximity sensors: colour of the ray"),
    ("visionSensor", "Vision sensors"),
    ("viewable", "Vision sensors and cameras"),
    ("camera", "Cameras"),
    ("forceSensor", "Force sensors"),
    ("light", "Lights"),
    ("lightColour", "Lights: colour of the light"),
    ("graph", "Graphs"),
    ("ocTree", "Octrees"),
    ("pointCloud", "Point clouds"),
];

/// The page.
pub(super) fn text() -> String {
    let lines = described();
    let count = |state: &str| lines.iter().filter(|line| line.state == state).count();
    let mut out = format!(
        "# Properties\n\nGenerated from the sources: `UPDATE=1 cargo test --test repository generated`. The {} static properties: those of \
         CoppeliaSim 4.10, and `rapier.solver` of joints ([PHYSICS](PHYSICS.md)), read and written with `sim.getIntProperty` and its like. Names below `customData.` and `signal.` come with scripts.\n\n\
         | state | what it is | properties |\n|---|---|---|\n\
         | works | has its meaning | {} |\n\
         | inert | is stored and read back, and has no effect | {} |\n\
         | constant | always reads as the same value | {} |\n",
        lines.len(),
        count("works"),
        count("inert"),
        count("constant")
    );
    for (part, title) in PARTS {
        let _ = write!(
            out,
            "\n## {title}\n\n| name | type | access | state | what it is |\n|---|---|---|---|---|\n"
        );
        for line in lines.iter().filter(|line| line.part == part) {
            let _ = writeln!(
                out,
                "| `{}` | {} | {} | {} | {} |",
                line.name,
                line.ty.word(),
                access(line.flags),
                line.state,
                line.description
            );
        }
    }
    out + &later()
}

/// Names of the version after 4.10 that are known here too.
fn later() -> String {
    let mut out = String::from(
        "\n## Names of CoppeliaSim 4.11\n\nThe version after 4.10 has other names for some properties. Both names are read and written; a value marked with *not* is true where the older one is false; \
         lists and events use the older one. Parameters of physics engines have `dynamics.` in front there (`dynamics.ode.bounce`). Handles are integers: \
         `sim.getHandleProperty` and `sim.getHandleArrayProperty` read the same values as `sim.getIntProperty` and `sim.getIntArrayProperty`. \
         `sim.getMatrixProperty` reads `vertices`, `normals`, `points`, `depth` and `inertiaMatrix`. Groups, lists of texts and properties without a counterpart in 4.10 are unknown.\n\n| of | name in 4.10 | name in 4.11 |\n|---|---|---|\n",
    );
    for name in later_names() {
        let not = if name.is_opposite { "*not* " } else { "" };
        let _ = writeln!(
            out,
            "| {} | {not}`{}` | `{}` |",
            name.class, name.name, name.later
        );
    }
    out
}

fn access(flags: i64) -> String {
    let read = if flags & flags::NOT_READABLE == 0 {
        "R"
    } else {
        ""
    };
    let write = if flags & flags::NOT_WRITABLE == 0 {
        "W"
    } else {
        ""
    };
    let deprecated = if flags & flags::DEPRECATED == 0 {
        ""
    } else {
        ", deprecated"
    };
    format!("{read}{write}{deprecated}")
}

#[cfg(test)]
mod tests {
    use super::{PARTS, described};

    #[test]
    fn every_part_has_a_title() {
        assert!(
            described()
                .iter()
                .all(|line| PARTS.iter().any(|(part, _)| *part == line.part))
        );
    }
}
