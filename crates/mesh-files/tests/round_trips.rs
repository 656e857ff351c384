//! What is written is read again.

use mesh_files::{
    ExportFormat, Limits, Material, MeshFile, MeshFormat, Part, Texture, UpAxis, WriteError, read,
    write,
};

const FORMATS: [(ExportFormat, MeshFormat); 7] = [
    (ExportFormat::Obj, MeshFormat::Obj),
    (ExportFormat::StlText, MeshFormat::Stl),
    (ExportFormat::StlBinary, MeshFormat::Stl),
    (ExportFormat::PlyText, MeshFormat::Ply),
    (ExportFormat::PlyBinary, MeshFormat::Ply),
    (ExportFormat::Collada, MeshFormat::Collada),
    (ExportFormat::Glb, MeshFormat::Gltf),
];

fn tetrahedron() -> Part {
    Part {
        name: "tip & <base>".into(),
        vertices: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        ..Part::default()
    }
}

/// Two parts: one plain, one with everything.
fn example() -> MeshFile {
    let material = Material {
        name: "paint".into(),
        diffuse: Some([1.0, 0.5, 0.25]),
        specular: Some([0.5; 3]),
        emission: Some([0.0, 0.0, 0.125]),
        transparency: 0.25,
        texture: Some(0),
        double_sided: false,
    };
    let painted = Part {
        normals: vec![
            [[0.0, 0.0, -1.0]; 3],
            [[0.0, -1.0, 0.0]; 3],
            [[-1.0, 0.0, 0.0]; 3],
            [[0.0, 0.0, 1.0]; 3],
        ],
        uv: vec![[[0.0, 0.0], [1.0, 0.0], [0.0, 0.75]]; 4],
        material,
        vertices: tetrahedron()
            .vertices
            .iter()
            .map(|[x, y, z]| [x + 2.0, *y, *z])
            .collect(),
        ..tetrahedron()
    };
    let textures = vec![Texture {
        name: "grain.png".into(),
        bytes: b"\x89PNG...".to_vec(),
    }];
    MeshFile {
        parts: vec![tetrahedron(), painted],
        textures,
        unit: Some(1.0),
        up: Some(UpAxis::Z),
        ..MeshFile::default()
    }
}

fn again(file: &MeshFile, format: ExportFormat, as_format: MeshFormat) -> MeshFile {
    let written = write(file, format, "out/mesh.any").expect("the format can be written");
    assert_eq!(written[0].name, "out/mesh.any");
    let mut beside = |name: &str| {
        let found = written
            .iter()
            .find(|file| file.name == name || file.name == format!("out/{name}"));
        found
            .map(|file| file.bytes.clone())
            .ok_or_else(|| "not written".to_owned())
    };
    let mut file = read(&written[0].bytes, as_format, Limits::default(), &mut beside)
        .expect("what was written can be read");
    if format == ExportFormat::Glb {
        file.turn_up(UpAxis::Y);
    }
    file.merge_identical();
    file
}

#[test]
fn geometry_survives_every_format() {
    for (format, as_format) in FORMATS {
        let file = again(&example(), format, as_format);
        let corners: Vec<[[f64; 3]; 3]> = file
            .parts
            .iter()
            .flat_map(|part| {
                part.triangles
                    .iter()
                    .map(|triangle| triangle.map(|i| part.vertices[i as usize]))
            })
            .collect();
        let expected: Vec<[[f64; 3]; 3]> = example()
            .parts
            .iter()
            .flat_map(|part| {
                part.triangles
                    .iter()
                    .map(|triangle| triangle.map(|i| part.vertices[i as usize]))
                    .collect::<Vec<_>>()
            })
            .collect();
        let far = corners
            .as_flattened()
            .as_flattened()
            .iter()
            .zip(expected.as_flattened().as_flattened())
            .any(|(a, b)| (a - b).abs() > 1e-12);
        assert!(
            corners.len() == expected.len() && !far,
            "{format:?}: {corners:?}"
        );
        assert_eq!(
            file.parts
                .iter()
                .map(|part| part.vertices.len())
                .sum::<usize>(),
            8,
            "{format:?}"
        );
    }
}

#[test]
fn looks_survive_the_formats_that_have_them() {
    for (format, as_format) in [FORMATS[0], FORMATS[5], FORMATS[6]] {
        let file = again(&example(), format, as_format);
        assert!(file.warnings.is_empty(), "{format:?}: {:?}", file.warnings);
        let (part, expected) = (&file.parts[1], &example().parts[1]);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(
            part.uv
                .as_flattened()
                .as_flattened()
                .iter()
                .zip(expected.uv.as_flattened().as_flattened())
                .all(|(a, b)| close(*a, *b))
        );
        let normals = part
            .normals
            .as_flattened()
            .as_flattened()
            .iter()
            .zip(expected.normals.as_flattened().as_flattened());
        assert!(
            normals.clone().count() == 36 && normals.into_iter().all(|(a, b)| close(*a, *b)),
            "{format:?}"
        );
        assert_eq!(part.material.emission, expected.material.emission);
        assert!(close(part.material.transparency, 0.25));
        assert_eq!(file.textures, example().textures, "{format:?}");
        assert_eq!(part.material.texture, Some(0));
    }
}

#[test]
fn every_up_axis_is_the_same_after_glb() {
    for up in [UpAxis::X, UpAxis::Y, UpAxis::Z] {
        let mut file = MeshFile {
            up: Some(up),
            ..example()
        };
        let mut read_back = again(&file, ExportFormat::Glb, MeshFormat::Gltf);
        file.turn_up(up);
        let near = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        let parts = read_back.parts.iter_mut().zip(&file.parts);
        for (part, expected) in parts {
            let corners = |part: &Part| {
                part.triangles
                    .as_flattened()
                    .iter()
                    .map(|index| part.vertices[*index as usize])
                    .collect::<Vec<_>>()
            };
            assert!(
                corners(part)
                    .iter()
                    .zip(&corners(expected))
                    .all(|(a, b)| near(a, b)),
                "{up:?}"
            );
        }
    }
}

#[test]
fn damaged_meshes_are_not_written() {
    let mut file = example();
    file.parts[1].triangles[2][0] = 4;
    assert_eq!(
        write(&file, ExportFormat::Obj, "x"),
        Err(WriteError::NoSuchVertex {
            part: 1,
            triangle: 2
        })
    );
    file.parts[0].vertices[3][1] = f64::NAN;
    assert_eq!(
        write(&file, ExportFormat::Glb, "x"),
        Err(WriteError::NotFinite { part: 0, vertex: 3 })
    );
}

#[test]
fn an_empty_file_is_written_and_then_refused() {
    for (format, as_format) in FORMATS {
        let written = write(&MeshFile::default(), format, "x").unwrap();
        let refused = read(&written[0].bytes, as_format, Limits::default(), &mut |_| {
            Err(String::new())
        })
        .unwrap_err();
        assert_eq!(refused.problem, "no triangles", "{format:?}");
    }
}

#[test]
fn parts_of_the_same_looks_are_joined() {
    let mut file = example();
    file.parts.push(tetrahedron());
    file.parts[2].normals = vec![[[0.0, 0.0, 1.0]; 3]; 4];
    file.merge_parts();
    assert_eq!(file.parts.len(), 2);
    let part = &file.parts[0];
    assert_eq!(
        (
            part.vertices.len(),
            part.triangles[4],
            part.normals.len(),
            part.uv.len()
        ),
        (8, [4, 6, 5], 8, 0)
    );
    assert_eq!(
        (part.normals[0], part.normals[7]),
        ([[0.0; 3]; 3], [[0.0, 0.0, 1.0]; 3])
    );
}
