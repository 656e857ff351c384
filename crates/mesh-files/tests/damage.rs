//! Damaged files are read or refused: cut at every length, and with each byte changed.

use mesh_files::{ExportFormat, Limits, MeshFile, MeshFormat, Part, read, write};

fn sample(format: ExportFormat) -> Vec<u8> {
    let part = Part {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]],
        triangles: vec![[0, 1, 2]],
        normals: vec![[[0.0, 0.0, 1.0]; 3]],
        ..Part::default()
    };
    write(
        &MeshFile {
            parts: vec![part],
            ..MeshFile::default()
        },
        format,
        "mesh",
    )
    .expect("a triangle is written")
    .remove(0)
    .bytes
}

/// What is read must be sound, whatever the bytes are.
fn try_to_read(bytes: &[u8], format: MeshFormat) -> bool {
    let limits = Limits {
        vertices: 1000,
        triangles: 1000,
        parts: 100,
    };
    let Ok(file) = read(bytes, format, limits, &mut |_| Err("nothing".into())) else {
        return false;
    };
    for part in &file.parts {
        assert!(
            part.triangles
                .as_flattened()
                .iter()
                .all(|index| (*index as usize) < part.vertices.len())
        );
        assert!(part.vertices.as_flattened().iter().all(|x| x.is_finite()));
        assert!(part.normals.is_empty() || part.normals.len() == part.triangles.len());
        assert!(part.uv.is_empty() || part.uv.len() == part.triangles.len());
    }
    true
}

fn damage(sample: &[u8], format: MeshFormat) {
    assert!(try_to_read(sample, format));
    for length in 0..sample.len() {
        try_to_read(&sample[..length], format);
    }
    for at in 0..sample.len() {
        for value in [
            0,
            1,
            0x7f,
            0x80,
            0xff,
            sample[at] ^ 1,
            sample[at].wrapping_add(1),
            b' ',
            b'-',
            b'9',
        ] {
            let mut changed = sample.to_vec();
            changed[at] = value;
            try_to_read(&changed, format);
        }
    }
}

#[test]
fn text_formats() {
    damage(&sample(ExportFormat::Obj), MeshFormat::Obj);
    damage(&sample(ExportFormat::StlText), MeshFormat::Stl);
    damage(&sample(ExportFormat::PlyText), MeshFormat::Ply);
}

#[test]
fn binary_formats() {
    damage(&sample(ExportFormat::StlBinary), MeshFormat::Stl);
    damage(&sample(ExportFormat::PlyBinary), MeshFormat::Ply);
    damage(&sample(ExportFormat::Glb), MeshFormat::Gltf);
}

#[test]
fn collada() {
    damage(&sample(ExportFormat::Collada), MeshFormat::Collada);
}

#[test]
fn dxf() {
    let face = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\na\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n";
    let mesh = "0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n192\n10\n1\n0\nVERTEX\n70\n192\n20\n1\n0\nVERTEX\n70\n192\n30\n1\n0\nVERTEX\n70\n128\n71\n1\n72\n-2\n73\n3\n0\nSEQEND\n";
    damage(
        format!("{face}{mesh}0\nENDSEC\n0\nEOF\n").as_bytes(),
        MeshFormat::Dxf,
    );
}

#[test]
fn three_ds() {
    let chunk = |kind: u16, content: &[u8]| {
        [
            &kind.to_le_bytes()[..],
            &(content.len() as u32 + 6).to_le_bytes(),
            content,
        ]
        .concat()
    };
    let vertices = [&3_u16.to_le_bytes()[..], &[0; 36]].concat();
    let faces: Vec<u8> = [1_u16, 0, 1, 2, 0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let painted = chunk(0x4130, b"red\0\x01\0\0\0");
    let mesh = chunk(
        0x4100,
        &[
            chunk(0x4110, &vertices),
            chunk(0x4120, &[faces, painted].concat()),
        ]
        .concat(),
    );
    let editor = [
        chunk(0xafff, &chunk(0xa000, b"red\0")),
        chunk(0x4000, &[&b"o\0"[..], &mesh].concat()),
    ]
    .concat();
    damage(&chunk(0x4d4d, &chunk(0x3d3d, &editor)), MeshFormat::ThreeDs);
}

#[test]
fn gltf_with_members_of_other_types() {
    let file = |values: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "buffers":[{{"uri":"data:;base64,AAAAAAAAgD8AAIA/AAAAAA=="}}],"bufferViews":[{{"buffer":0,"byteLength":16}}],
            "accessors":[{{"componentType":5126,"type":"VEC3","count":3,
            "sparse":{{"count":1,"indices":{{"bufferView":0,"componentType":5121}},"values":{values}}}}}]}}"#
        )
    };
    assert!(try_to_read(
        file(r#"{"bufferView":0,"byteOffset":4}"#).as_bytes(),
        MeshFormat::Gltf
    ));
    let limits = Limits {
        vertices: 1000,
        triangles: 1000,
        parts: 100,
    };
    for values in ["5", "\"a\"", "[1]", "true", "null"] {
        let refused = read(
            file(values).as_bytes(),
            MeshFormat::Gltf,
            limits,
            &mut |_| Err("nothing".into()),
        );
        assert_eq!(
            refused.expect_err("no object").to_string(),
            "accessor 0: sparse without values",
            "{values}"
        );
    }
}

#[test]
fn collada_with_very_many_attributes_is_refused_at_once() {
    let many: String = (0..100_000)
        .map(|number| format!(" a{number}=''"))
        .collect();
    let limits = Limits {
        vertices: 1000,
        triangles: 1000,
        parts: 100,
    };
    let file = format!("<COLLADA>\n<asset{many}/></COLLADA>");
    let refused = read(file.as_bytes(), MeshFormat::Collada, limits, &mut |_| {
        Err("nothing".into())
    });
    assert_eq!(
        refused.expect_err("too many").to_string(),
        "line 2: XML: an element has more than 200 attributes"
    );
}
