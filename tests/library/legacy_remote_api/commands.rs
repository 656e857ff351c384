//! What commands do: objects, joints, sensors, pictures, scripts.

use super::simx::{BLOCKING, Client, Server, command, floats, ints, read_floats, read_ints, text};

const SCENE: &str = "
    sim = require 'sim'
    local function named(handle, alias) sim.setObjectAlias(handle, alias) return handle end
    local box = named(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}), 'box')
    sim.setObjectPosition(box, {0, 0, 1})
    local joint = named(sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0), 'joint')
    local ball = named(sim.createJoint(sim.joint_spherical, sim.jointmode_kinematic, 0), 'ball')
    local eye = named(sim.createVisionSensor(0, {4, 2, 0, 0}, {0.01, 10, 1, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0}), 'eye')
    local pixels = {} for i = 0, 23 do pixels[i + 1] = string.char(i * 10) end
    sim.setVisionSensorImg(eye, table.concat(pixels), 4)
    named(sim.createProximitySensor(sim.proximitysensor_ray, 16, 0, {0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 'ray')
    named(sim.createForceSensor(0, {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}), 'force')
    function echo(ints, floats, strings, buffer) return ints, floats, strings, buffer, 'ignored' end
    function short() return {}, {}, {} end
    function wrong() return {'no number'}, {}, {}, '' end
    function fails() error('on purpose') end
";

fn serve() -> (Server, Client) {
    let server = Server::start(SCENE);
    let client = server.connect();
    (server, client)
}

const WORLD: [u8; 4] = (-1_i32).to_le_bytes();

#[test]
fn names_of_both_kinds_and_their_absence() {
    let (_server, mut client) = serve();
    assert_eq!(client.handle("box"), client.handle("/box"));
    assert!(client.errors().is_empty());
    assert!(client.fails(0x3001, &text("nothing"), &[]));
    let errors = client.errors();
    assert!(
        errors.len() == 1 && errors[0].starts_with("[simGetObjectHandle] "),
        "{errors:?}"
    );
    assert!(client.errors().is_empty());
}

#[test]
fn poses() {
    let (_server, mut client) = serve();
    let object = client.handle("box");
    client.get(
        0x101b,
        &object,
        &[&WORLD[..], &floats(&[1.0, 2.0, 3.0])].concat(),
    );
    client.get(
        0x101a,
        &object,
        &[&WORLD[..], &floats(&[0.0, 0.0, 0.5])].concat(),
    );
    let key = [object, WORLD].concat();
    assert_eq!(read_floats(&client.get(0x200e, &key, &[])), [1.0, 2.0, 3.0]);
    assert!((read_floats(&client.get(0x200d, &key, &[]))[2] - 0.5).abs() < 1e-6);
    client.get(
        0x1801,
        &object,
        &[&WORLD[..], &floats(&[0.0, 0.0, 1.0, 0.0])].concat(),
    );
    assert_eq!(
        read_floats(&client.get(0x2801, &key, &[])),
        [0.0, 0.0, 1.0, 0.0]
    );
    assert_eq!(
        read_floats(&client.get(0x1019, &object, &WORLD)),
        [1.0, 2.0, 3.0],
        "as old clients ask"
    );
    assert!(client.fails(0x200e, &ints(&[999_999, -1]), &[]));
    assert!(client.fails(0x101b, &object, &[0; 5]), "incomplete");
}

#[test]
fn the_tree_of_objects() {
    let (_server, mut client) = serve();
    let (object, joint) = (client.handle("box"), client.handle("joint"));
    client.get(0x101c, &object, &[&joint[..], &[1]].concat());
    assert_eq!(client.get(0x1012, &object, &[]), joint);
    assert_eq!(client.get(0x200b, &[joint, [0; 4]].concat(), &[]), object);
    assert_eq!(
        read_ints(&client.get(0x200b, &ints(&[999_999, 0]), &[])),
        [-1]
    );
    assert_eq!(read_ints(&client.get(0x1012, &ints(&[999_999]), &[])), [-1]);
    let shapes = read_ints(&client.get(0x102a, &ints(&[0]), &[]));
    assert!(
        shapes[0] as usize == shapes.len() - 1 && shapes[1..].contains(&i32::from_le_bytes(object))
    );
    let copies = read_ints(&client.get(0x102e, &ints(&[0]), &object));
    client.get(0x102f, &ints(&[0]), &ints(&[copies[1]]));
    assert_eq!(read_ints(&client.get(0x0006, &[], &[])), [1, copies[1]]);
    client.get(0x1028, &ints(&[copies[1]]), &[]);
    assert_eq!(read_ints(&client.get(0x0006, &[], &[])), [0]);
}

#[test]
fn joints() {
    let (_server, mut client) = serve();
    let joint = client.handle("joint");
    client.get(0x1002, &joint, &floats(&[0.25]));
    assert_eq!(read_floats(&client.get(0x1001, &joint, &[])), [0.25]);
    client.get(0x100e, &joint, &floats(&[12.0]));
    assert_eq!(read_floats(&client.get(0x1038, &joint, &[])), [12.0]);
    assert_eq!(read_floats(&client.get(0x100d, &joint, &[])), [0.0]);
    assert_eq!(client.get(0x100a, &joint, &[]).len(), 48);
    let ball = client.handle("ball");
    assert!(client.fails(0x100d, &ball, &[]) && client.fails(0x1001, &ball, &[]));
    assert!(!client.fails(
        0x100b,
        &ball,
        &floats(&[0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0])
    ));
    assert!(client.fails(0x1008, &ints(&[777]), &floats(&[1.5])));
}

#[test]
fn pictures() {
    let (_server, mut client) = serve();
    let eye = client.handle("eye");
    let colours: Vec<u8> = (0..24).map(|i| i * 10).collect();
    assert_eq!(
        client.get(0x1004, &eye, &[]),
        [ints(&[4, 2]), colours].concat()
    );
    let greys = [10, 40, 70, 100, 130, 160, 190, 220].to_vec();
    assert_eq!(
        client.get(0x1003, &eye, &[]),
        [ints(&[4, 2]), greys].concat()
    );
    assert_eq!(client.get(0x1017, &eye, &[]).len(), 8 + 8 * 4);
    let image: Vec<u8> = (0..24).collect();
    client.get(0x1006, &eye, &image);
    assert_eq!(client.get(0x1004, &eye, &[])[8..], image);
    client.get(0x1005, &eye, &[7; 8]);
    assert_eq!(client.get(0x1004, &eye, &[])[8..], [7; 24]);
    assert!(client.fails(0x1006, &eye, &image[..23]));
    let object = client.handle("box");
    assert!(client.fails(0x1004, &object, &[]));
}

#[test]
fn sensors() {
    let (_server, mut client) = serve();
    let (eye, ray, force) = (
        client.handle("eye"),
        client.handle("ray"),
        client.handle("force"),
    );
    assert_eq!(client.get(0x1009, &ray, &[]).len(), 29);
    let reading = client.get(0x100f, &force, &[]);
    assert_eq!((reading.len(), reading[0]), (25, 0));
    assert!(client.fails(0x1011, &force, &[]));
    let answer = client.call(command(0x1011, BLOCKING, &eye, &[]));
    assert!(answer.status == 1 || answer.data.len() > 5);
    assert!(client.fails(0x1009, &eye, &[]));
}

#[test]
fn sensors_of_a_running_simulation() {
    let (_server, mut client) = serve();
    client.get(0x0001, &[], &[]);
    client.get(0x1007, &ints(&[0]), &[]);
    client.get(0x0003, &[], &[]);
    let eye = client.handle("eye");
    let reading = client.get(0x1011, &eye, &[]);
    assert_eq!(
        (read_ints(&reading[1..9]), reading.len()),
        (vec![1, 15], 9 + 15 * 4)
    );
    let ray = client.handle("ray");
    assert_eq!(client.get(0x1009, &ray, &[]).len(), 29);
}

#[test]
fn parameters() {
    let (_server, mut client) = serve();
    assert_eq!(read_ints(&client.get(0x1021, &ints(&[1]), &[])), [41_000]);
    assert_eq!(read_floats(&client.get(0x1023, &ints(&[1]), &[])), [0.05]);
    client.get(0x1024, &ints(&[1]), &floats(&[0.01]));
    assert_eq!(read_floats(&client.get(0x1023, &ints(&[1]), &[])), [0.01]);
    assert_eq!(read_floats(&client.get(0x101d, &ints(&[0]), &[]))[2], -9.81);
    assert_eq!(read_ints(&client.get(0x101f, &ints(&[45]), &[])), [0]);
    client.get(0x1020, &ints(&[25]), &ints(&[1]));
    assert_eq!(client.exchange(&[]).state & 1, 0);
    assert!(client.fails(0x1021, &ints(&[9999]), &[]));
    let object = client.handle("box");
    assert!(
        client.fails(0x2007, &[object, 1_i32.to_le_bytes()].concat(), &[]),
        "no parameter of a shape"
    );
}

#[test]
fn data_of_many_objects() {
    let (_server, mut client) = serve();
    let joint = i32::from_le_bytes(client.handle("joint"));
    let ball = i32::from_le_bytes(client.handle("ball"));
    let states = client.get(0x200c, &ints(&[1, 15]), &[]);
    assert_eq!(read_ints(&states[..24]), [2, 0, 4, 0, joint, ball]);
    assert_eq!(read_floats(&states[24..]), [0.0; 4]);
    for kind in 0..=21 {
        let data = client.get(0x200c, &ints(&[109, kind]), &[]);
        let counts = read_ints(&data[..16]);
        assert!(
            counts[0] >= 7 && counts[1..].iter().sum::<i32>() >= counts[0],
            "kind {kind}: {counts:?}"
        );
    }
    assert_eq!(
        read_ints(&client.get(0x200c, &ints(&[2, 0]), &[])),
        [0; 4],
        "there is no graph"
    );
    assert!(client.fails(0x200c, &ints(&[12_345_678, 0]), &[]));
    assert!(client.fails(0x200c, &ints(&[109, 99]), &[]));
}

#[test]
fn distances_and_collisions() {
    let (_server, mut client) = serve();
    let (object, floor) = (client.handle("box"), client.handle("/Floor"));
    let key = [object, floor].concat();
    assert_eq!(read_ints(&client.get(0x200f, &key, &[])), [0]);
    let distance = read_floats(&client.get(0x2010, &key, &[]))[0];
    assert!((0.8..1.0).contains(&distance), "{distance}");
    assert!(client.fails(0x300a, &text("x"), &[]) && client.fails(0x300b, &text("x"), &[]));
}

fn function(client: &mut Client, name: &str) -> Vec<u8> {
    let script = client.handle("/Script");
    [&script[..], &[0], &text(name)].concat()
}

#[test]
fn functions_of_scripts() {
    let (_server, mut client) = serve();
    let key = function(&mut client, "echo");
    let values = [
        ints(&[2, 1, 2, 3, 1, 2]),
        floats(&[0.5]),
        text("ab"),
        text("c"),
        b"\0\x01z".to_vec(),
    ]
    .concat();
    assert_eq!(client.get(0x3401, &key, &values), values);
    assert_eq!(client.get(0x3401, &key, &[0; 16]), [0; 16]);
    for name in ["short", "wrong", "nothing"] {
        let key = function(&mut client, name);
        assert!(client.fails(0x3401, &key, &[0; 16]), "{name}");
        assert_eq!(client.errors().len(), 1, "{name}");
    }
    assert!(client.fails(
        0x3401,
        &[&[9, 9, 9, 0][..], &text(""), &text("echo")].concat(),
        &[0; 16]
    ));
    let key = function(&mut client, "echo");
    assert!(
        client.fails(
            0x3401,
            &key,
            &ints(&[i32::MAX, i32::MAX, i32::MAX, i32::MAX])
        ),
        "sizes that lie"
    );
    let key = function(&mut client, "fails");
    assert!(client.fails(0x3401, &key, &[0; 16]));
}

#[test]
fn dummies_consoles_and_collections() {
    let (_server, mut client) = serve();
    let dummy = client.get(
        0x0009,
        &[],
        &[&floats(&[0.1])[..], &[1], &[255; 12]].concat(),
    );
    assert_eq!(client.get(0x1012, &dummy, &[]), WORLD);
    let options = [
        ints(&[10, 0, 98_765, 0, 98_765, 0]),
        floats(&[-6.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
    ]
    .concat();
    let console = client.get(0x3009, &text("title"), &options);
    client.get(0x1015, &console, &text("line"));
    client.get(0x1015, &console, &[]);
    client.get(0x1016, &console, &ints(&[0]));
    client.get(0x1014, &console, &[]);
    assert!(client.fails(
        0x300c,
        &text("title"),
        &[text("question"), ints(&[0]), text("")].concat()
    ));
    assert!(client.fails(0x3019, &text("group"), &[]));
    client.get(0x3014, &text("group"), &ints(&[77]));
    assert_eq!(read_ints(&client.get(0x3019, &text("group"), &[])), [77]);
    client.get(0x300e, &text(""), &[]);
    assert!(client.fails(0x3011, &text("group"), &[]), "all are removed");
}
