//! Objects and sensors by name and handle, contacts, names of data, serial ports.

use crate::dispatch::Call;
use crate::functions::{Answer, Function};
use scene::numbers;
use scene::{Data, Key};

/// Added to the index of a contact: its normal is wanted as well.
const EXTENDED: i64 = 0x40_0000;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("object.find", find_object),
    ("script.find", find_script),
    ("sensor.read", |call| {
        detection(call, "sim.readProximitySensor")
    }),
    ("sensor.handle", |call| {
        detection(call, "sim.handleProximitySensor")
    }),
    ("sensor.check", |call| {
        detection(call, "sim.checkProximitySensor")
    }),
    ("sensor.check_points", check_points),
    ("camera.read", |call| packets(call, "sim.readVisionSensor")),
    ("camera.handle", |call| {
        packets(call, "sim.handleVisionSensor")
    }),
    ("camera.check", |call| {
        packets(call, "sim.checkVisionSensor")
    }),
    ("contact.info", contact),
    ("names.persistent", |call| {
        names(call, "sim.getPersistentDataTags")
    }),
    ("names.custom", |call| {
        names(call, "sim.readCustomDataBlockTags")
    }),
    ("property.name", property_name),
    ("serial.read", read_serial),
];

fn find_object(call: &Call<'_>) -> Answer {
    let (index, proxy, flags) = (call.int(1)?, call.int(2)?, call.int(3)?);
    let mut options = vec![("noError", Data::Bool(flags & 1 != 0))];
    options.extend((index >= 0).then_some(("index", Data::Int(index))));
    options.extend((proxy >= 0).then_some(("proxy", Data::Int(proxy))));
    let options = options
        .into_iter()
        .map(|(key, value)| (Key::Text(key.into()), value))
        .collect();
    call.frame.host.call(
        "sim.getObject",
        &[Data::Text(call.bytes(0)?.to_vec()), Data::Map(options)],
    )
}

/// By the object it belongs to, or else by name.
fn find_script(call: &Call<'_>) -> Answer {
    let owner = if call.int(1)? >= 0 {
        call.arg(1)
    } else {
        call.arg(2)
    };
    call.frame
        .host
        .call("sim.getScript", &[call.arg(0).clone(), owner.clone()])
}

/// Parameters: sensor, corners, the kind of items, their count, mode, threshold, greatest angle.
fn check_points(call: &Call<'_>) -> Answer {
    let corners = match call.integer_at(2) {
        kind @ 0..=2 => numbers::index(kind as f64) + 1,
        kind => {
            return Err(format!(
                "{kind} is no kind of items: 0 are points, 1 segments, 2 triangles"
            ));
        }
    };
    let count = call.count_at(3)?.saturating_mul(3 * corners);
    let mut args = call.args.clone();
    args[1] = call.numbers_at(1, count)?;
    detected(call.frame.host.call("sim.checkProximitySensorEx2", &args)?)
}

/// Whether something was detected; point and distance; the object; the normal.
fn detection(call: &Call<'_>, function: &str) -> Answer {
    detected(call.frame.host.call(function, &call.args)?)
}

fn detected(results: Vec<Data>) -> Answer {
    let mut results = results.into_iter();
    let (state, distance) = (results.next().unwrap_or(Data::Int(0)), results.next());
    let point = match results.next() {
        Some(Data::Array(mut point)) => {
            point.extend(distance);
            Data::Array(point)
        }
        _ => Data::Nil,
    };
    Ok([state, point].into_iter().chain(results).collect())
}

/// Whether something was detected; the numbers of all packets; how many packets there are, and how many numbers in each.
fn packets(call: &Call<'_>, function: &str) -> Answer {
    let mut results = call.frame.host.call(function, &call.args)?.into_iter();
    let state = results.next().unwrap_or(Data::Int(-1));
    let mut packets: Vec<Vec<Data>> = results.map(items).collect();
    // Scripts get empty packets besides those there are.
    while packets.last().is_some_and(Vec::is_empty) {
        packets.pop();
    }
    let counts = std::iter::once(packets.len())
        .chain(packets.iter().map(Vec::len))
        .map(numbers::count);
    let counts = counts.collect::<Vec<_>>().into();
    Ok(vec![
        state,
        Data::Array(packets.into_iter().flatten().collect()),
        counts,
    ])
}

/// Whether there is such a contact; the two objects; point, force and, if it is wanted, normal.
fn contact(call: &Call<'_>) -> Answer {
    let [pass, object, index] = [call.int(0)?, call.int(1)?, call.int(2)?];
    let args = [
        Data::Int(pass),
        Data::Int(object),
        Data::Int(index & !EXTENDED),
    ];
    let mut results = call
        .frame
        .host
        .call("sim.getContactInfo", &args)?
        .into_iter()
        .map(items);
    let objects = results.next().unwrap_or_default();
    let vectors = if index & EXTENDED != 0 { 3 } else { 2 };
    let numbers = results.take(vectors).flatten().collect();
    Ok(vec![
        Data::Bool(!objects.is_empty()),
        Data::Array(objects),
        Data::Array(numbers),
    ])
}

/// Names, each with a NUL behind it, and how many they are.
fn names(call: &Call<'_>, function: &str) -> Answer {
    let names: Vec<Data> = call
        .frame
        .host
        .call(function, &call.args)?
        .into_iter()
        .flat_map(items)
        .collect();
    let count = Data::Int(numbers::count(names.len()));
    let text: Vec<u8> = names
        .into_iter()
        .flat_map(|name| [bytes(name), vec![0]].concat())
        .collect();
    Ok(vec![
        if text.is_empty() {
            Data::Nil
        } else {
            Data::Buffer(text)
        },
        count,
    ])
}

fn property_name(call: &Call<'_>) -> Answer {
    if *call.arg(2) != Data::Nil {
        return Err("options are not implemented in Swanilda".into());
    }
    call.frame.host.call("sim.getPropertyName", &call.args[..2])
}

/// How many bytes were read, and the bytes.
fn read_serial(call: &Call<'_>) -> Answer {
    let bytes: Vec<u8> = call
        .frame
        .host
        .call("sim.serialRead", &call.args)?
        .into_iter()
        .take(1)
        .flat_map(bytes)
        .collect();
    let count = Data::Int(numbers::count(bytes.len()));
    Ok(vec![
        count,
        bytes.into_iter().map(i64::from).collect::<Vec<_>>().into(),
    ])
}

/// The items of a table; nothing of all else.
pub(super) fn items(data: Data) -> Vec<Data> {
    if let Data::Array(items) = data {
        items
    } else {
        Vec::new()
    }
}

/// The bytes of a text; nothing of all else.
pub(super) fn bytes(data: Data) -> Vec<u8> {
    if let Data::Text(bytes) | Data::Buffer(bytes) = data {
        bytes
    } else {
        Vec::new()
    }
}
