//! What is shown: messages of the user interface, dialogs, views, points, particles, curves of graphs.

use scene::{Data, numbers};

use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// More than particles have.
const MOST_PARAMETERS: f64 = 64.0;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("message.next", message),
    ("dialog.display", dialog),
    ("camera.fit", fit_camera),
    ("drawing.points", show_points),
    ("particles.add", add_particles),
    ("graph.curve", add_curve),
];

/// No text, the number of the message and its four numbers, no length.
fn message(call: &Call<'_>) -> Answer {
    let message = call.frame.host().call("sim.getSimulatorMessage", &[])?;
    let numbers = message.into_iter().take(2);
    Ok([Data::Nil]
        .into_iter()
        .chain(numbers)
        .chain([Data::Int(0)])
        .collect())
}

/// The handle of a dialog, which belongs to no element of a user interface. It does not wait.
fn dialog(call: &Call<'_>) -> Answer {
    let mut args = call.args[..3].to_vec();
    args.push(Data::Bool(false));
    let mut results = call.frame.host().call("sim.displayDialog", &args)?;
    results.truncate(1);
    results.push(Data::Int(-1));
    Ok(results)
}

/// Parameters: view or camera, count of objects, objects or NULL for all, options, scale.
fn fit_camera(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        call.optional_integers_at(2, call.count_at(1)?)?,
        Data::Int(call.integer_at(3)),
        Data::Float(call.number_at(4)),
    ];
    call.frame.host().call("sim.cameraFitToView", &args)
}

/// Parameters: masks of pages and layers, object, options, size, count, coordinates, a colour for all, colours, normals.
fn show_points(call: &Call<'_>) -> Answer {
    let mut args = call.args[..5].to_vec();
    args.push(call.numbers_at(6, call.count_at(5)?.saturating_mul(3))?);
    let colour: Option<Vec<u8>> = call.optional_at(7, 3)?;
    let colour = colour.unwrap_or_default().into_iter().map(i64::from);
    args.push(colour.collect::<Vec<_>>().into());
    call.frame.host().call("sim.addPointCloud", &args)
}

/// Parameters: kind, size, density, its parameters, life time, count, colours.
fn add_particles(call: &Call<'_>) -> Answer {
    let mut args = call.args[..6].to_vec();
    // The list begins with the number of pairs that follow.
    args[3] = match call.optional_at::<f32>(3, 1)?.as_deref() {
        Some([count]) => {
            let pairs = numbers::index(f64::from(*count).clamp(0.0, MOST_PARAMETERS));
            call.numbers_at(3, 1 + 2 * pairs)?
        }
        _ => Data::Nil,
    };
    args.extend([call.arg(6).clone(), Data::Nil]);
    args.extend([8, 9].map(|place| call.arg(place).clone()));
    call.frame.host().call("sim.addParticleObject", &args)
}

/// Parameters: graph, name, dimensions, streams and values for each dimension, unit, options, colour, width.
fn add_curve(call: &Call<'_>) -> Answer {
    let dimensions = call.count_at(2)?;
    let mut args = call.args.clone();
    args[3] = call.integers_at(3, dimensions)?;
    args[4] = call.optional_numbers_at(4, dimensions)?;
    if args[4] == Data::Nil {
        args[4] = vec![0.0; dimensions].into();
    }
    if args[7] == Data::Nil {
        args[7] = Data::from([1.0, 1.0, 0.0]);
    }
    call.frame.host().call("sim.addGraphCurve", &args)
}
