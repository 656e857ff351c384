//! Differences between two scenes: objects added, removed, moved, changed; their scripts line by line.

use std::collections::{BTreeMap, BTreeSet};

use super::{Mesh, Outline, OutlineItem, lines};

/// Numbers that differ by less, relative to their size, are the same: saving rounds.
const SAME: f64 = 1e-6;

/// The differences in words, one per line, then those of scripts; empty when there are none.
pub fn differences(a: &Outline, b: &Outline) -> String {
    let mut out = String::new();
    fields(&mut out, "scene", &a.settings, &b.settings, |_| false);
    let pairs = pairs(a, b);
    let paired: BTreeSet<&str> = pairs.iter().map(|(old, _)| old.path.as_str()).collect();
    let found: BTreeSet<&str> = pairs.iter().map(|(_, new)| new.path.as_str()).collect();
    for item in a
        .objects
        .iter()
        .filter(|item| !paired.contains(item.path.as_str()))
    {
        out += &format!("removed {} ({})\n", item.path, item.kind);
    }
    for item in b
        .objects
        .iter()
        .filter(|item| !found.contains(item.path.as_str()))
    {
        out += &format!("added   {} ({})\n", item.path, item.kind);
        scripts(&mut out, &item.path, &[], &item.scripts);
    }
    for (old, new) in pairs {
        if old.path != new.path {
            out += &format!("moved   {} -> {}\n", old.path, new.path);
        }
        if old.kind != new.kind {
            out += &format!("changed {}: {} -> {}\n", new.path, old.kind, new.kind);
        }
        let same_mesh = |name: &str| match (old.meshes.get(name), new.meshes.get(name)) {
            (Some(old), Some(new)) => old.is_near(new),
            _ => false,
        };
        fields(&mut out, &new.path, &old.fields, &new.fields, same_mesh);
        scripts(&mut out, &new.path, &old.scripts, &new.scripts);
    }
    out
}

/// The same object in both: of the same path, or else of the same identity.
fn pairs<'a>(a: &'a Outline, b: &'a Outline) -> Vec<(&'a OutlineItem, &'a OutlineItem)> {
    let new: BTreeMap<&str, &OutlineItem> = b
        .objects
        .iter()
        .map(|item| (item.path.as_str(), item))
        .collect();
    let old: BTreeSet<&str> = a.objects.iter().map(|item| item.path.as_str()).collect();
    let strays = b
        .objects
        .iter()
        .filter(|item| !old.contains(item.path.as_str()));
    let mut strays: BTreeMap<&str, &OutlineItem> = strays
        .map(|item| (item.persistent_id.as_str(), item))
        .collect();
    let pair = |item: &'a OutlineItem| {
        let other = new
            .get(item.path.as_str())
            .copied()
            .or_else(|| strays.remove(item.persistent_id.as_str()))?;
        Some((item, other))
    };
    a.objects.iter().filter_map(pair).collect()
}

/// `is_same` knows by their names fields that are the same though their values are not.
fn fields(
    out: &mut String,
    path: &str,
    a: &[(String, String)],
    b: &[(String, String)],
    is_same: impl Fn(&str) -> bool,
) {
    let new: BTreeMap<&str, &str> = b
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()))
        .collect();
    let old: BTreeSet<&str> = a.iter().map(|(name, _)| name.as_str()).collect();
    for (name, value) in a {
        let word = if name == "pose" { "moved  " } else { "changed" };
        match new.get(name.as_str()) {
            Some(other) if !same(value, other) && !is_same(name) => {
                out.push_str(&format!("{word} {path}: {name}: {value} -> {other}\n"));
            }
            Some(_) => {}
            None => out.push_str(&format!("changed {path}: {name}: {value} -> nothing\n")),
        }
    }
    for (name, value) in b.iter().filter(|(name, _)| !old.contains(name.as_str())) {
        out.push_str(&format!("changed {path}: {name}: nothing -> {value}\n"));
    }
}

/// The same but for rounding.
fn same(a: &str, b: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        text.split(['[', ']', ',', ' '])
            .filter(|w| !w.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let near = |a: &String, b: &String| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= SAME * (1.0 + a.abs()),
        _ => a == b,
    };
    let (x, y) = (words(a), words(b));
    a == b || (x.len() == y.len() && x.iter().zip(&y).all(|(a, b)| near(a, b)))
}

impl Mesh {
    /// The same but for rounding, which changes the sums.
    fn is_near(&self, other: &Self) -> bool {
        let near =
            |(a, b): (&f32, &f32)| f64::from((a - b).abs()) <= SAME * f64::from(1.0 + a.abs());
        self.indices == other.indices
            && self.vertices.len() == other.vertices.len()
            && self.vertices.iter().zip(&other.vertices).all(near)
    }
}

fn scripts(out: &mut String, path: &str, a: &[(String, String)], b: &[(String, String)]) {
    let names: BTreeSet<&str> = a.iter().chain(b).map(|(name, _)| name.as_str()).collect();
    let find = |list: &[(String, String)], name: &str| {
        list.iter()
            .find(|(own, _)| own == name)
            .map(|(_, text)| text.clone())
            .unwrap_or_default()
    };
    for name in names {
        let difference = lines::unified(&find(a, name), &find(b, name));
        if !difference.is_empty() {
            out.push_str(&format!(
                "--- a{path} {name}\n+++ b{path} {name}\n{difference}"
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::tests::{own_files, real_files};
    use crate::scene_file::{SceneFile, save};
    use crate::ttt::tree::Class;
    use crate::ttt::{File, Rest};
    use scene::Scene;

    fn outline(file: File) -> Outline {
        Outline::new(SceneFile::new(file).unwrap()).unwrap()
    }

    fn robot() -> File {
        File::read(&std::fs::read(&own_files()[0]).unwrap()).unwrap()
    }

    #[test]
    fn a_scene_is_the_same_as_itself() {
        for path in own_files()
            .into_iter()
            .chain(real_files().into_iter().take(6))
        {
            let file = File::read(&std::fs::read(&path).unwrap()).unwrap();
            assert_eq!(
                differences(&outline(file.clone()), &outline(file)),
                "",
                "{}",
                path.display()
            );
        }
    }

    #[test]
    fn a_scene_that_is_saved_again_is_the_same() {
        for path in own_files()
            .into_iter()
            .chain(real_files().into_iter().take(6))
        {
            let file = File::read(&std::fs::read(&path).unwrap()).unwrap();
            let (mut scene, source) = (Scene::new(), SceneFile::new(file.clone()).unwrap());
            let as_scene = !source.is_model();
            let loaded = source.add_to(&mut scene, as_scene).unwrap();
            let saved = save::scene(&scene, &loaded.scripts).unwrap();
            let (mut opened, other) = (outline(file), outline(saved));
            // A model is saved as the scene that it is in.
            if !as_scene {
                opened.settings.clone_from(&other.settings);
            }
            assert_eq!(differences(&opened, &other), "", "{}", path.display());
        }
    }

    #[test]
    fn meshes_may_differ_by_rounding() {
        let moved = |metres: f32| {
            let mut file = robot();
            let pool = file.contents.mesh_pool.as_mut().unwrap();
            pool.vertices
                .iter_mut()
                .for_each(|Rest(vertices)| vertices[0] += metres);
            outline(file)
        };
        assert_eq!(differences(&moved(0.0), &moved(1e-7)), "");
        assert!(
            differences(&moved(0.0), &moved(1e-3)).contains(".triangles: "),
            "a millimetre counts"
        );
    }

    #[test]
    fn differences_are_listed() {
        let mut other = robot();
        for object in &mut other.contents.objects {
            let alias = object.common.alias.as_ref().unwrap().decode();
            match &mut object.class {
                Class::Dummy(_) if alias == "tip" => object.common.alias = Some("end".into()),
                Class::Joint(joint) => joint.motor = Some([0.5, 7.0]),
                Class::ScriptObject(script) => {
                    let text = script.script.as_mut().unwrap().text.as_mut().unwrap();
                    text.0.extend(b"-- more\n");
                }
                _ => {}
            }
        }
        let report = differences(&outline(robot()), &outline(other));
        assert!(
            report.contains("moved   /robot/joint/arm/tip -> /robot/joint/arm/end\n"),
            "{report}"
        );
        assert!(
            report.contains("changed /robot/joint: Joint.motor: [0.0, 2.5] -> [0.5, 7.0]\n"),
            "{report}"
        );
        assert!(report.contains("+-- more\n"), "{report}");
        assert_eq!(
            report
                .lines()
                .filter(|line| line.starts_with("changed"))
                .count(),
            1,
            "{report}"
        );
    }
}
