//! Commands that are one call of a function of `sim`.

use super::call::{Call, Failure, Outcome, bytes, integer};
use scene::Data;

/// An argument of the function: where it comes from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Arg {
    /// The next integer of the key.
    Key,
    /// The next text of the key.
    KeyText,
    /// The next integer of the data.
    Int,
    /// A byte of the data: whether it is not 0.
    Flag,
    /// An integer of the data: whether it is not 0.
    Switch,
    Float,
    /// So many numbers of the data, as a table.
    Floats(usize),
    /// A text of the data; nil where there is none.
    OptionalText,
    /// Integers of the data, as a table.
    Ints,
    Constant(i64),
}

/// A result of the function: what is written of it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Out {
    Int,
    /// A number, or the numbers of a table.
    Floats,
    Text,
    /// A table of integers, with their number.
    Ints,
    Nothing,
}

/// A command.
pub(super) struct Direct {
    pub id: u16,
    pub function: &'static str,
    pub args: &'static [Arg],
    pub out: &'static [Out],
    /// Arguments as the protocol has them are in another order than the function's: the last comes first.
    pub last_first: bool,
}

use Arg::{Constant, Flag, Float, Floats, Int, Ints, Key, KeyText, OptionalText, Switch};

const fn row(id: u16, function: &'static str, args: &'static [Arg], out: &'static [Out]) -> Direct {
    Direct {
        id,
        function,
        args,
        out,
        last_first: false,
    }
}

/// Of an object relative to another: the reference comes first in the data, and last in the call.
const fn placing(id: u16, function: &'static str, args: &'static [Arg]) -> Direct {
    Direct {
        id,
        function,
        args,
        out: &[],
        last_first: true,
    }
}

/// The commands, by their numbers.
pub(super) static DIRECT: &[Direct] = &[
    row(0x0005, "sim.closeScene", &[], &[]),
    row(0x0006, "sim.getObjectSel", &[], &[Out::Ints]),
    row(0x1001, "sim.getJointPosition", &[Key], &[Out::Floats]),
    row(0x1002, "sim.setJointPosition", &[Key, Float], &[]),
    row(0x1008, "sim.setJointTargetVelocity", &[Key, Float], &[]),
    row(0x100a, "sim.getJointMatrix", &[Key], &[Out::Floats]),
    row(
        0x100b,
        "sim.setSphericalJointMatrix",
        &[Key, Floats(12)],
        &[],
    ),
    row(0x100c, "sim.setJointTargetPosition", &[Key, Float], &[]),
    row(0x100e, "sim.setJointMaxForce", &[Key, Float], &[]),
    row(0x1010, "sim.breakForceSensor", &[Key], &[]),
    row(0x1014, "sim.auxiliaryConsoleClose", &[Key], &[]),
    row(
        0x1015,
        "sim.auxiliaryConsolePrint",
        &[Key, OptionalText],
        &[],
    ),
    row(0x1016, "sim.auxiliaryConsoleShow", &[Key, Switch], &[]),
    row(
        0x1018,
        "sim.getObjectOrientation",
        &[Key, Int],
        &[Out::Floats],
    ),
    row(0x1019, "sim.getObjectPosition", &[Key, Int], &[Out::Floats]),
    placing(0x101a, "sim.setObjectOrientation", &[Key, Int, Floats(3)]),
    placing(0x101b, "sim.setObjectPosition", &[Key, Int, Floats(3)]),
    row(0x101c, "sim.setObjectParent", &[Key, Int, Flag], &[]),
    row(0x101d, "sim.getArrayParam", &[Key], &[Out::Floats]),
    row(0x101e, "sim.setArrayParam", &[Key, Floats(3)], &[]),
    row(0x101f, "sim.getBoolParam", &[Key], &[Out::Int]),
    row(0x1020, "sim.setBoolParam", &[Key, Switch], &[]),
    row(0x1021, "sim.getInt32Param", &[Key], &[Out::Int]),
    row(0x1022, "sim.setInt32Param", &[Key, Int], &[]),
    row(0x1023, "sim.getFloatParam", &[Key], &[Out::Floats]),
    row(0x1024, "sim.setFloatParam", &[Key, Float], &[]),
    row(0x1025, "sim.getStringParam", &[Key], &[Out::Text]),
    row(0x1026, "sim.readCollision", &[Key], &[Out::Int]),
    row(
        0x1027,
        "sim.readDistance",
        &[Key],
        &[Out::Nothing, Out::Floats],
    ),
    row(0x1028, "sim.removeObject", &[Key], &[]),
    row(0x102b, "sim.endDialog", &[Key], &[]),
    row(0x102c, "sim.getDialogInput", &[Key], &[Out::Text]),
    row(0x102d, "sim.getDialogResult", &[Key], &[Out::Int]),
    row(
        0x102e,
        "sim.copyPasteObjects",
        &[Ints, Constant(0)],
        &[Out::Ints],
    ),
    row(0x102f, "sim.setObjectSel", &[Ints], &[]),
    row(0x1034, "sim.getModelProperty", &[Key], &[Out::Int]),
    row(0x1035, "sim.setModelProperty", &[Key, Int], &[]),
    row(
        0x1036,
        "sim.getObjectVelocity",
        &[Key],
        &[Out::Floats, Out::Floats],
    ),
    row(0x1037, "sim.removeModel", &[Key], &[]),
    placing(0x1801, "sim.setObjectQuaternion", &[Key, Int, Floats(4)]),
    row(
        0x2007,
        "sim.getObjectFloatParam",
        &[Key, Key],
        &[Out::Floats],
    ),
    row(0x2008, "sim.getObjectInt32Param", &[Key, Key], &[Out::Int]),
    row(0x2009, "sim.setObjectFloatParam", &[Key, Key, Float], &[]),
    row(0x200a, "sim.setObjectInt32Param", &[Key, Key, Int], &[]),
    row(
        0x200d,
        "sim.getObjectOrientation",
        &[Key, Key],
        &[Out::Floats],
    ),
    row(0x200e, "sim.getObjectPosition", &[Key, Key], &[Out::Floats]),
    row(0x200f, "sim.checkCollision", &[Key, Key], &[Out::Int]),
    row(
        0x2801,
        "sim.getObjectQuaternion",
        &[Key, Key],
        &[Out::Floats],
    ),
    row(0x3001, "sim._getObjectHandle", &[KeyText], &[Out::Int]),
    row(0x300a, "sim.getCollisionHandle", &[KeyText], &[Out::Int]),
    row(0x300b, "sim.getDistanceHandle", &[KeyText], &[Out::Int]),
    row(0x3010, "sim.getFloatSignal", &[KeyText], &[Out::Floats]),
    row(0x3011, "sim.getInt32Signal", &[KeyText], &[Out::Int]),
    row(0x3013, "sim.setFloatSignal", &[KeyText, Float], &[]),
    row(0x3014, "sim.setInt32Signal", &[KeyText, Int], &[]),
];

impl Direct {
    /// Executes the command.
    ///
    /// # Errors
    /// Those of the function; when the data is incomplete, and where the function returns nothing or -1.
    pub(super) fn execute(&self, call: &mut Call<'_>) -> Outcome {
        let mut args = self
            .args
            .iter()
            .map(|arg| arg.read(call))
            .collect::<Result<Vec<_>, _>>()?;
        if self.last_first {
            args[1..].reverse();
        }
        let results = call.api(self.function, &args)?;
        if self.out.is_empty() {
            return if results.first() == Some(&Data::Int(-1)) {
                Err(Failure::Silent)
            } else {
                Ok(())
            };
        }
        for (place, out) in self.out.iter().enumerate() {
            out.write(results.get(place).unwrap_or(&Data::Nil), call)?;
        }
        Ok(())
    }
}

impl Arg {
    fn read(self, call: &mut Call<'_>) -> Result<Data, Failure> {
        Ok(match self {
            Key => call.handle()?,
            KeyText => Data::Text(call.key.text()?.to_vec()),
            Int => Data::Int(call.data.int()?.into()),
            Flag => Data::Bool(call.data.byte()? != 0),
            Switch => Data::Bool(call.data.int()? != 0),
            Float => Data::Float(call.data.float()?.into()),
            Floats(count) => call.numbers(count)?,
            OptionalText if call.data.is_empty() => Data::Nil,
            OptionalText => Data::Text(call.data.text()?.to_vec()),
            Ints => call.integers()?.into(),
            Constant(value) => Data::Int(value),
        })
    }
}

impl Out {
    fn write(self, result: &Data, call: &mut Call<'_>) -> Outcome {
        match (self, result) {
            (Self::Nothing, _) => {}
            (_, Data::Nil) => return Err(Failure::Silent),
            (Self::Int, value) => call.write_int(integer(value)),
            (Self::Floats, value) => call.write_floats(value),
            (Self::Text, value) => call.out.text(bytes(value)),
            (Self::Ints, Data::Array(items)) => {
                call.write_list(&items.iter().map(integer).collect::<Vec<_>>());
            }
            (Self::Ints, _) => call.write_list(&[]),
        }
        Ok(())
    }
}
