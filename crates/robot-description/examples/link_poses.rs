//! Prints what was read from a URDF or MJCF file, or of the first model of an SDF file, and where its links are: `cargo run --example link_poses -- robot.urdf < positions`.
//!
//! A line of the input has pairs `joint=position`, with commas between the numbers of a position; joints without are at 0. For each, a line of the output has x, y, z, qx, qy, qz, qw of every link.
//! Before them: a line for each warning, joint and link. `tests/compare.py` compares them with other programs.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use mesh_files::MeshFormat;
use robot_description::mjcf::{self, Files, Triangles};
use robot_description::{Parsed, Robot, sdf, urdf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("which file?")?;
    let parsed = read(&file)?;
    for warning in &parsed.warnings {
        println!("warning\t{warning}");
    }
    print_parts(&parsed.value);
    for line in std::io::stdin().lock().lines() {
        println!("poses\t{}", poses(&parsed.value, &line?)?);
    }
    Ok(())
}

/// Files in a folder.
struct Beside(PathBuf);

impl Files for Beside {
    fn include(&mut self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(self.0.join(name)).map_err(|error| error.to_string())
    }

    fn triangles(&mut self, file: &str) -> Result<Triangles, String> {
        let path = self.0.join(file);
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let format = MeshFormat::of_name(file).ok_or("a format that is not known")?;
        let mut nothing = |_: &str| Err("not looked for".to_owned());
        let file = mesh_files::read(&bytes, format, mesh_files::Limits::default(), &mut nothing)
            .map_err(|error| error.to_string())?;
        let mut mesh = Triangles::default();
        for part in &file.parts {
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(part.vertices.iter().copied());
            mesh.corners.extend(
                part.triangles
                    .iter()
                    .map(|triangle| triangle.map(|corner| corner + first)),
            );
        }
        Ok(mesh)
    }
}

fn read(file: &str) -> Result<Parsed<Robot>, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(file)?;
    if file.ends_with(".urdf") {
        return Ok(urdf::read(&bytes)?);
    }
    if mjcf::is_mjcf(&bytes) {
        let folder = Path::new(&file)
            .parent()
            .unwrap_or(Path::new(""))
            .to_owned();
        let parsed = mjcf::read(&bytes, &mut Beside(folder))?;
        let Parsed {
            value,
            warnings,
            further_warnings,
        } = parsed;
        return Ok(Parsed {
            value: value.robot,
            warnings,
            further_warnings,
        });
    }
    let parsed = sdf::read(&bytes, &mut |name| Err(format!("{name}: not looked for")))?;
    let model = parsed
        .value
        .models
        .into_iter()
        .next()
        .ok_or("the file has no model")?;
    Ok(Parsed {
        value: model.robot,
        warnings: parsed.warnings,
        further_warnings: parsed.further_warnings,
    })
}

fn print_parts(robot: &Robot) {
    for joint in &robot.joints {
        println!(
            "joint\t{}\t{:?}\t{}",
            joint.name,
            joint.kind,
            joint.mimic.is_some()
        );
    }
    for link in &robot.links {
        println!("line\t{}\t{}", link.name, link.line);
        let Some(inertial) = &link.inertial else {
            println!("link\t{}", link.name);
            continue;
        };
        let com = inertial.pose.translation.vector;
        let rotation = inertial.pose.rotation.coords;
        let numbers: Vec<f64> = [inertial.mass]
            .into_iter()
            .chain(com.iter().copied())
            .chain(rotation.iter().copied())
            .chain(inertial.inertia)
            .collect();
        println!("link\t{}\t{}", link.name, joined(&numbers));
    }
}

fn poses(robot: &Robot, line: &str) -> Result<String, Box<dyn std::error::Error>> {
    let mut positions = robot.zero_positions();
    for pair in line.split('\t').filter(|pair| !pair.is_empty()) {
        let (name, value) = pair.rsplit_once('=').ok_or("pairs are joint=position")?;
        let index = robot
            .joint(name)
            .ok_or_else(|| format!("no joint '{name}'"))?;
        let start: usize = robot.joints[..index]
            .iter()
            .map(|joint| joint.kind.numbers())
            .sum();
        for (place, number) in value.split(',').enumerate() {
            *positions.get_mut(start + place).ok_or("too many numbers")? = number.parse()?;
        }
    }
    let poses = robot.link_poses(&positions)?;
    let numbers = poses.iter().flat_map(|pose| {
        pose.translation
            .vector
            .iter()
            .chain(pose.rotation.coords.iter())
            .copied()
            .collect::<Vec<f64>>()
    });
    Ok(joined(&numbers.collect::<Vec<f64>>()))
}

fn joined(numbers: &[f64]) -> String {
    numbers
        .iter()
        .map(f64::to_string)
        .collect::<Vec<String>>()
        .join(" ")
}
