//! What the readers of formats with nodes, materials or layers make of a file, in small files of each kind.

mod common;

use common::{error, parsed};
use mesh_files::{Limits, MeshFormat, UpAxis, read};

/// A COLLADA file of a triangle in a scene.
fn collada(asset: &str, nodes: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>{asset}</asset>
        <library_images><image id=\"im\"><init_from>file://pictures/a%2epng</init_from></image></library_images>
        <library_effects><effect id=\"e\"><profile_COMMON>
            <newparam sid=\"su\"><surface type=\"2D\"><init_from>im</init_from></surface></newparam>
            <newparam sid=\"sa\"><sampler2D><source>su</source></sampler2D></newparam>
            <technique sid=\"t\"><phong><emission><color>0 0 1 1</color></emission><diffuse><texture texture=\"sa\"/></diffuse>
            <transparent opaque=\"RGB_ZERO\"><color>0.5 0.5 0.5 1</color></transparent></phong></technique></profile_COMMON></effect></library_effects>
        <library_materials><material id=\"m\" name=\"glass\"><instance_effect url=\"#e\"/></material></library_materials>
        <library_geometries><geometry id=\"g\"><mesh>
            <source id=\"p\"><float_array>9 0 0 0  9 1 0 0  9 0 2 0</float_array><technique_common>
                <accessor count=\"3\" stride=\"4\" offset=\"1\"/></technique_common></source>
            <vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>
            <polylist count=\"1\" material=\"sym\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"1\"/><vcount>3</vcount><p>7 0 7 1 7 2</p></polylist>
        </mesh></geometry></library_geometries>
        <library_nodes><node id=\"shared\"><translate>0 0 5</translate><instance_geometry url=\"#g\"><bind_material><technique_common>
            <instance_material symbol=\"sym\" target=\"#m\"/></technique_common></bind_material></instance_geometry></node></library_nodes>
        <library_visual_scenes><visual_scene id=\"s\">{nodes}</visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"
    )
}

#[test]
fn collada_places_geometry_by_the_nodes_of_the_scene() {
    let nodes = "<node name=\"n\"><translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 -1</scale><instance_node url=\"#shared\"/></node>";
    let file = parsed(
        collada("<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>", nodes).as_bytes(),
        MeshFormat::Collada,
    )
    .unwrap();
    assert_eq!((file.unit, file.up), (Some(0.01), Some(UpAxis::Z)));
    let part = &file.parts[0];
    assert_eq!(
        part.vertices,
        [[1.0, 0.0, -5.0], [1.0, 2.0, -5.0], [-1.0, 0.0, -5.0]]
    );
    assert_eq!(
        part.triangles,
        [[0, 2, 1]],
        "a scale that mirrors turns triangles over"
    );
    let material = &part.material;
    assert_eq!(
        (
            material.name.as_str(),
            material.emission,
            material.transparency.round()
        ),
        ("glass", Some([0.0, 0.0, 1.0]), 1.0)
    );
    assert_eq!(file.textures[material.texture.unwrap()].name, "a.png");
}

#[test]
fn collada_nodes_that_contain_themselves_are_refused() {
    let nodes = "<node id=\"a\"><instance_node url=\"#b\"/></node><node id=\"b\"><instance_node url=\"#a\"/></node>";
    assert!(
        error(collada("", nodes).as_bytes(), MeshFormat::Collada)
            .contains("a node that contains itself")
    );
    let mut doubling = String::from("<node id=\"n0\"><instance_geometry url=\"#g\"/></node>");
    for k in 1..90 {
        let url = format!("<instance_node url=\"#n{}\"/>", k - 1);
        doubling += &format!("<node id=\"n{k}\">{url}{url}</node>");
    }
    assert!(error(collada("", &doubling).as_bytes(), MeshFormat::Collada).contains("more than"));
}

#[test]
fn collada_with_entities_of_its_own_is_refused() {
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE c [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;\">]><COLLADA>&b;</COLLADA>";
    assert!(error(bomb.as_bytes(), MeshFormat::Collada).contains("XML: "));
    let deep = "<a>".repeat(200_000);
    assert!(error(deep.as_bytes(), MeshFormat::Collada).contains("XML: "));
}

#[test]
fn collada_errors_name_line_and_element() {
    let file = collada("", "<node><instance_geometry url=\"#g\"/></node>");
    assert_eq!(
        error(
            file.replace("7 2</p>", "7 3</p>").as_bytes(),
            MeshFormat::Collada
        ),
        "line 13: p: an index beyond the 3 positions"
    );
    assert_eq!(
        error(
            file.replace("9 1 0 0", "9 1 0 oh").as_bytes(),
            MeshFormat::Collada
        ),
        "line 10: float_array: not a finite number: \"oh\""
    );
    assert_eq!(
        error(
            file.replace("url=\"#g\"", "url=\"#h\"").as_bytes(),
            MeshFormat::Collada
        ),
        "line 17: instance_geometry: url \"#h\" names nothing in this file"
    );
}

/// A glTF of a triangle in a buffer of its own.
fn gltf(nodes: &str, accessor: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"name":"m","primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
        "materials":[{{"name":"paint","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0,0.25],"baseColorTexture":{{"index":0}}}},"alphaMode":"BLEND"}}],
        "textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,iVBORw=="}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3",{accessor}}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36,"uri":"points.bin"}}]}}"#
    )
}

#[test]
fn gltf_places_meshes_by_its_nodes() {
    let nodes = r#"{"translation":[0,0,1],"children":[1]},{"name":"n","mesh":0,"matrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 5,0,0,1]}"#;
    let file = parsed(gltf(nodes, r#""count":3"#).as_bytes(), MeshFormat::Gltf).unwrap();
    assert_eq!(
        (file.unit, file.up, file.parts[0].name.as_str()),
        (Some(1.0), Some(UpAxis::Y), "n")
    );
    assert_eq!(
        file.parts[0].vertices,
        [[5.0, 0.0, 1.0], [7.0, 0.0, 1.0], [5.0, 2.0, 1.0]]
    );
    let material = &file.parts[0].material;
    assert_eq!(
        (material.diffuse, material.transparency),
        (Some([1.0, 0.5, 0.0]), 0.75)
    );
    assert_eq!(
        (&file.textures[0].name[..], &file.textures[0].bytes[..]),
        ("image0.png", &b"\x89PNG"[..])
    );
}

#[test]
fn gltf_errors_name_the_element() {
    let node = r#"{"mesh":0}"#;
    assert_eq!(
        error(gltf(node, r#""count":4"#).as_bytes(), MeshFormat::Gltf),
        "accessor 0: 4 rows do not fit into bufferView 0"
    );
    assert!(
        error(
            gltf(node, r#""count":18446744073709551615"#).as_bytes(),
            MeshFormat::Gltf
        )
        .contains("more than the limit")
    );
    let cycle = r#"{"mesh":0,"children":[1]},{"children":[0]}"#;
    assert_eq!(
        error(gltf(cycle, r#""count":3"#).as_bytes(), MeshFormat::Gltf),
        "node 0: in the scene twice, or inside itself"
    );
    let draco = gltf(node, r#""count":3"#).replacen(
        '{',
        r#"{"extensionsRequired":["KHR_draco_mesh_compression"],"#,
        1,
    );
    assert_eq!(
        error(draco.as_bytes(), MeshFormat::Gltf),
        "extensionsRequired: KHR_draco_mesh_compression is not supported"
    );
    assert!(error("[".repeat(10_000).as_bytes(), MeshFormat::Gltf).contains("recursion"));
    let gone = gltf(node, r#""count":3"#).replace("points.bin", "gone.bin");
    assert_eq!(
        error(gone.as_bytes(), MeshFormat::Gltf),
        "buffer 0: no such file"
    );
}

/// A chunk of 3DS.
fn chunk(kind: u16, content: &[u8]) -> Vec<u8> {
    [
        &kind.to_le_bytes()[..],
        &(content.len() as u32 + 6).to_le_bytes(),
        content,
    ]
    .concat()
}

/// A 3DS file of a square, of whose triangles one is red.
pub fn three_ds() -> Vec<u8> {
    let corners = [
        [0.0_f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let vertices = [
        &4_u16.to_le_bytes()[..],
        &corners
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<_>>(),
    ]
    .concat();
    let painted = chunk(0x4130, b"red\0\x01\0\x01\0");
    let faces: Vec<u8> = [2_u16, 0, 1, 2, 0, 0, 2, 3, 0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let mesh = chunk(
        0x4100,
        &[
            chunk(0x4110, &vertices),
            chunk(0x4120, &[faces, painted].concat()),
        ]
        .concat(),
    );
    let texture = chunk(0xa200, &chunk(0xa300, b"a picture.png\0"));
    let material = [
        chunk(0xa000, b"red\0"),
        chunk(0xa020, &chunk(0x0011, &[255, 0, 0])),
        chunk(0xa050, &chunk(0x0030, &[50, 0])),
        texture,
    ];
    let editor = [
        chunk(0xafff, &material.concat()),
        chunk(0x4000, &[&b"square\0"[..], &mesh].concat()),
    ]
    .concat();
    chunk(0x4d4d, &chunk(0x3d3d, &editor))
}

#[test]
fn three_ds_has_a_part_for_each_material() {
    let file = parsed(&three_ds(), MeshFormat::ThreeDs).unwrap();
    let [red, rest] = &file.parts[..] else {
        panic!()
    };
    assert_eq!(
        (red.vertices.len(), rest.vertices.len(), red.name.as_str()),
        (3, 3, "square")
    );
    assert_eq!(
        (red.material.diffuse, red.material.transparency),
        (Some([1.0, 0.0, 0.0]), 0.5)
    );
    assert_eq!(
        file.textures[red.material.texture.unwrap()].name,
        "a picture.png"
    );
}

#[test]
fn dxf_has_a_part_for_each_layer() {
    let face = |layer: &str, last: &str| {
        format!(
            "0\n3DFACE\n8\n{layer}\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n{last}"
        )
    };
    let mesh = "0\nPOLYLINE\n8\nb\n70\n16\n71\n2\n72\n2\n0\nVERTEX\n10\n0\n20\n0\n0\nVERTEX\n10\n0\n20\n1\n0\nVERTEX\n10\n1\n20\n0\n0\nVERTEX\n10\n1\n20\n1\n0\nSEQEND\n";
    let text = format!(
        "0\nSECTION\n2\nENTITIES\n{}{}{mesh}0\nENDSEC\n0\nEOF\n",
        face("a", "13\n0\n23\n1\n33\n0\n"),
        face("b", "13\n1\n23\n1\n33\n0\n")
    );
    let file = parsed(text.as_bytes(), MeshFormat::Dxf).unwrap();
    let counts: Vec<_> = file
        .parts
        .iter()
        .map(|part| (part.name.as_str(), part.triangles.len()))
        .collect();
    assert_eq!(counts, [("a", 2), ("b", 3)]);
    let curves = "0\nSECTION\n2\nENTITIES\n0\n3DSOLID\n0\nARC\n0\nENDSEC\n0\nEOF\n";
    assert_eq!(
        error(curves.as_bytes(), MeshFormat::Dxf),
        "file: no 3DFACE and no POLYLINE mesh, but: 1 3DSOLID, 1 ARC"
    );
}

#[test]
fn instances_are_limited() {
    let limits = Limits {
        parts: 3,
        ..Limits::default()
    };
    let node = "<node><instance_geometry url=\"#g\"/></node>".repeat(4);
    let file = collada("", &node);
    let refused = read(file.as_bytes(), MeshFormat::Collada, limits, &mut |_| {
        Err(String::new())
    })
    .unwrap_err();
    assert_eq!(refused.to_string(), "parts: more than the limit");
}
