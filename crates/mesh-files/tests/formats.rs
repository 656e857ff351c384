//! What each reader makes of a file, in small files of each kind.

mod common;

use common::{error, parsed};
use mesh_files::MeshFormat;

#[test]
fn obj_has_a_part_for_each_group_and_material() {
    let text = b"mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n\
        o lid\nusemtl red\nf 1/1/1 2/2/1 \\\n3/3/1\nusemtl plain\nf -4 -2 -1\no lid\nusemtl red\nf 1 2 4\n";
    let file = parsed(text, MeshFormat::Obj).unwrap();
    assert_eq!(file.parts.len(), 2);
    let [red, plain] = &file.parts[..] else {
        panic!()
    };
    assert_eq!(
        (red.name.as_str(), red.triangles.len(), red.vertices.len()),
        ("lid", 2, 4)
    );
    assert_eq!(red.normals, [[[0.0, 0.0, 1.0]; 3], [[0.0; 3]; 3]]);
    assert_eq!(red.uv[0], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    let material = &red.material;
    assert_eq!(
        (material.diffuse, material.specular, material.transparency),
        (Some([1.0, 0.0, 0.0]), Some([0.5; 3]), 0.75)
    );
    assert_eq!(
        file.textures[material.texture.unwrap()].name,
        "a picture.png"
    );
    assert_eq!(
        (
            plain.vertices.len(),
            plain.normals.len(),
            plain.material.name.as_str()
        ),
        (3, 0, "plain")
    );
}

#[test]
fn obj_without_its_materials_is_read_with_a_warning() {
    let file = parsed(
        b"mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
        MeshFormat::Obj,
    )
    .unwrap();
    assert_eq!(file.warnings, ["materials gone.mtl: no such file"]);
}

#[test]
fn obj_errors_name_the_line() {
    assert_eq!(
        error(b"v 0 0 0\nv 1 0\n", MeshFormat::Obj),
        "line 2: vertex: a number is missing"
    );
    assert_eq!(
        error(b"v 0 0 0\nv 1 0 nan\n", MeshFormat::Obj),
        "line 2: vertex: not a finite number: \"nan\""
    );
    assert_eq!(
        error(b"v 0 0 0\nf 1 1 2\n", MeshFormat::Obj),
        "line 2: face: \"2\" names nothing that was defined before"
    );
    assert_eq!(
        error(b"v 0 0 0\nf 1 1 0\n", MeshFormat::Obj),
        "line 2: face: \"0\" names nothing that was defined before"
    );
    assert_eq!(error(b"v 0 0 0\n", MeshFormat::Obj), "file: no triangles");
}

/// A binary STL of one triangle under a header.
fn binary_stl(header: &[u8], count: u32) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(count.to_le_bytes());
    bytes.extend(
        [
            0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
        ]
        .iter()
        .flat_map(|x| x.to_le_bytes()),
    );
    bytes.extend([0, 0]);
    bytes
}

#[test]
fn stl_is_binary_or_text_whatever_it_begins_with() {
    for header in [
        &b"made by hand"[..],
        b"solid of a program that lies",
        b"solid facet facet",
    ] {
        assert_eq!(
            parsed(&binary_stl(header, 1), MeshFormat::Stl)
                .unwrap()
                .parts[0]
                .triangles,
            [[0, 1, 2]]
        );
    }
    let text = b"solid two words\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid two words\n";
    let file = parsed(text, MeshFormat::Stl).unwrap();
    assert_eq!(
        (file.parts[0].name.as_str(), file.parts[0].triangles.len()),
        ("two words", 1)
    );
    assert_eq!(
        parsed(&text.to_ascii_uppercase(), MeshFormat::Stl)
            .unwrap()
            .parts[0]
            .triangles
            .len(),
        1
    );
}

#[test]
fn stl_has_the_colour_of_its_header() {
    let file = parsed(&binary_stl(b"x COLOR=\xff\x00\x33\xff", 1), MeshFormat::Stl).unwrap();
    assert_eq!(file.parts[0].material.diffuse, Some([1.0, 0.0, 0.2]));
}

#[test]
fn stl_errors_name_line_or_byte() {
    assert_eq!(
        error(&binary_stl(b"", u32::MAX), MeshFormat::Stl),
        "byte 84: triangles: 4294967295 of 50 bytes each are announced, the file has 50 bytes more"
    );
    assert_eq!(
        error(
            b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n",
            MeshFormat::Stl
        ),
        "line 4: vertex: not a finite number: \"x\""
    );
    assert_eq!(
        error(b"solid\nfacet\nvertex 0 0 0\n", MeshFormat::Stl),
        "line 4: facet: the file ends before `endfacet`"
    );
}

const PLY: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
    element edge 1\nproperty list uchar short anything\nelement face 1\nproperty list uchar int vertex_indices\nproperty uchar flags\nend_header\n";

#[test]
fn ply_is_the_same_in_all_three_encodings() {
    let text = format!(
        "ply\nformat ascii 1.0\ncomment a b c\n{PLY}0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n2 5 -6\n4 0 1 2 3 7\n"
    );
    let expected = parsed(text.as_bytes(), MeshFormat::Ply).unwrap();
    assert_eq!(expected.parts[0].triangles, [[0, 1, 2], [0, 2, 3]]);
    for big in [false, true] {
        let mut bytes = format!(
            "ply\nformat binary_{}_endian 1.0\n{PLY}",
            if big { "big" } else { "little" }
        )
        .into_bytes();
        let mut push = |mut value: Vec<u8>| {
            if big {
                value.reverse();
            }
            bytes.extend(value);
        };
        for [x, y] in [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            [x, y, 0.0]
                .into_iter()
                .for_each(|x| push(x.to_le_bytes().into()));
            push(vec![9]);
        }
        push(vec![2]);
        [5_i16, -6]
            .into_iter()
            .for_each(|x| push(x.to_le_bytes().into()));
        push(vec![4]);
        [0_i32, 1, 2, 3]
            .into_iter()
            .for_each(|x| push(x.to_le_bytes().into()));
        push(vec![7]);
        assert_eq!(parsed(&bytes, MeshFormat::Ply).unwrap(), expected);
    }
}

#[test]
fn ply_errors_name_the_line_and_counts_are_compared_with_the_length() {
    let head = "ply\nformat ascii 1.0\n";
    let huge = format!(
        "{head}element vertex 99999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"
    );
    assert!(
        error(huge.as_bytes(), MeshFormat::Ply)
            .contains("99999999999 are announced, the file is shorter")
    );
    let beyond = format!(
        "{head}element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n3 0 0 1\n"
    );
    assert_eq!(
        error(beyond.as_bytes(), MeshFormat::Ply),
        "line 11: face: vertex 1 of 1"
    );
    assert_eq!(
        error(b"ply\nformat odd 1.0\n", MeshFormat::Ply),
        "line 2: header: unknown format \"odd\""
    );
    let empty = format!("{head}element nothing 18446744073709551615\nend_header\n");
    assert_eq!(
        error(empty.as_bytes(), MeshFormat::Ply),
        "file: no triangles"
    );
}

#[test]
fn ply_strips_alternate() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 3\n";
    assert_eq!(
        parsed(text.as_bytes(), MeshFormat::Ply).unwrap().parts[0].triangles,
        [[0, 1, 2], [2, 1, 3], [2, 1, 3]]
    );
}
