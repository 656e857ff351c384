//! The commands of the legacy remote API by their numbers (spec: legacy-remote-api 5).

use capture::{Input, Recorded};

use super::call::{Call, Failure, Outcome};
use super::direct::DIRECT;
use super::service::Service;
use super::services::update_waiting;
use super::{files, group_data, objects, script_call, sensors, signals};
use script::Host;
use wire::simx::{Answer, ByteOrder, Command, FieldReader, FieldWriter};

type Special = (u16, fn(&mut Call<'_>) -> Outcome);

/// Commands that are more than one call; the others are in [`DIRECT`].
static SPECIAL: &[Special] = &[
    (0x0001, |call| synchronize(call, true)),
    (0x0002, |call| synchronize(call, false)),
    (0x0003, trigger),
    (0x0004, last_errors),
    (0x0009, objects::create_dummy),
    (0x1003, sensors::grey_image),
    (0x1004, sensors::colour_image),
    (0x1005, sensors::set_grey_image),
    (0x1006, sensors::set_colour_image),
    (0x1007, change_state),
    (0x1009, sensors::proximity),
    (0x100d, |call| {
        objects::joint_force(call, "sim.getJointForce")
    }),
    (0x100f, sensors::force),
    (0x1011, sensors::vision),
    (0x1012, objects::parent),
    (0x1017, sensors::depth),
    (0x102a, objects::all_of_type),
    (0x1038, |call| {
        objects::joint_force(call, "sim.getJointMaxForce")
    }),
    (0x200b, objects::child),
    (0x200c, group_data::read),
    (0x2010, objects::distance),
    (0x3002, files::load_scene),
    (0x3003, files::load_model),
    (0x3004, files::transfer),
    (0x3006, files::erase),
    (0x3008, objects::log),
    (0x3009, objects::open_console),
    (0x300c, objects::display_dialog),
    (0x300d, |call| signals::clear(call, "sim.clearFloatSignal")),
    (0x300e, |call| signals::clear(call, "sim.clearInt32Signal")),
    (0x300f, |call| signals::clear(call, "sim.clearStringSignal")),
    (0x3012, signals::read),
    (0x3015, signals::set),
    (0x3016, signals::append),
    (0x3017, signals::take),
    (0x3018, signals::read_stream),
    (0x3019, objects::collection),
    (0x3401, script_call::call),
];

/// A command of a client.
pub(super) struct Asked {
    pub(super) id: u16,
    pub(super) key: Vec<u8>,
    pub(super) data: Vec<u8>,
    pub(super) order: ByteOrder,
    /// The reply has no room for its results.
    pub(super) is_full: bool,
}

impl Asked {
    pub(super) fn new(command: &Command, order: ByteOrder, is_full: bool) -> Self {
        Self {
            id: command.id,
            key: command.key.clone(),
            data: command.data.clone(),
            order,
            is_full,
        }
    }
}

impl Recorded for Asked {
    fn write(&self, out: &mut Vec<u8>) {
        self.id.write(out);
        self.key.write(out);
        self.data.write(out);
        (self.order == ByteOrder::Big, self.is_full).write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let (id, key, data) = Recorded::read(input)?;
        let (is_big, is_full) = Recorded::read(input)?;
        let order = if is_big {
            ByteOrder::Big
        } else {
            ByteOrder::Little
        };
        Some(Self {
            id,
            key,
            data,
            order,
            is_full,
        })
    }
}

/// Executes a command of a client.
pub(super) fn execute(host: &Host<'_>, service: &Service, command: &Asked) -> Answer {
    let order = command.order;
    let (key, data) = (
        FieldReader::new(&command.key, order),
        FieldReader::new(&command.data, order),
    );
    let mut call = Call {
        host,
        service,
        key,
        data,
        out: FieldWriter::new(order),
        ends_stream: false,
    };
    match perform(command.id, &mut call) {
        Some(Ok(())) => Answer {
            failed: false,
            ends_stream: call.ends_stream,
            data: call.out.into_bytes(),
        },
        Some(Err(Failure::Text(text))) => {
            service.note_error(text);
            Answer::failure()
        }
        Some(Err(Failure::Silent)) => Answer::failure(),
        None => Answer {
            failed: true,
            data: command.data.clone(),
            ends_stream: false,
        },
    }
}

/// What a command does; None for an unknown one.
fn perform(id: u16, call: &mut Call<'_>) -> Option<Outcome> {
    if let Some(direct) = DIRECT.iter().find(|direct| direct.id == id) {
        return Some(direct.execute(call));
    }
    SPECIAL
        .iter()
        .find(|(special, _)| *special == id)
        .map(|(_, function)| function(call))
}

fn synchronize(call: &mut Call<'_>, on: bool) -> Outcome {
    call.service.synchronize(on)?;
    update_waiting(call.host);
    Ok(())
}

/// Allows the next step.
fn trigger(call: &mut Call<'_>) -> Outcome {
    let clock = call.host.clock();
    if !clock.state().is_advancing() {
        return Err(Failure::Text("the simulation is not running.".into()));
    }
    call.service.trigger(clock.steps())?;
    update_waiting(call.host);
    Ok(())
}

fn last_errors(call: &mut Call<'_>) -> Outcome {
    let errors = call.service.take_errors();
    call.out.size(errors.len());
    errors
        .iter()
        .for_each(|text| call.out.text(text.as_bytes()));
    Ok(())
}

/// Starts, pauses or stops the simulation.
fn change_state(call: &mut Call<'_>) -> Outcome {
    let function = match call.key.int()? {
        0 => "sim.startSimulation",
        1 => "sim.pauseSimulation",
        2 => "sim._stopSimulation",
        _ => return Err(Failure::Silent),
    };
    call.api(function, &[]).map(drop)
}

#[cfg(test)]
mod tests {
    use script::Registry;

    use super::*;

    #[test]
    fn no_number_stands_for_two_commands() {
        let mut ids: Vec<u16> = DIRECT.iter().map(|direct| direct.id).collect();
        ids.extend(SPECIAL.iter().map(|(id, _)| *id));
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), count);
    }

    #[test]
    fn every_function_exists() {
        let registry = Registry::new(&[&api::SIM], lua_library::FILES);
        let missing = |name: &&str| registry.find(name).is_none();
        let unknown: Vec<&str> = DIRECT
            .iter()
            .map(|direct| direct.function)
            .filter(missing)
            .collect();
        assert_eq!(unknown, [""; 0]);
    }
}
