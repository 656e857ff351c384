//! The callbacks scripts may define (`sysCall_*`), with their numbers (spec: callbacks 1).

macro_rules! callbacks {
    ($($variant:ident = $code:literal $name:literal),* $(,)?) => {
        /// A callback of a script. Its number is `sim.syscb_*`.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum SysCall { $(#[doc = concat!("The callback `", $name, "`.")] $variant = $code),* }

        impl SysCall {
            /// All callbacks.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name of the global function.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }
        }
    };
}

callbacks! {
    Info = 0 "sysCall_info",
    Cleanup = 1 "sysCall_cleanup",
    Init = 2 "sysCall_init",
    NonSimulation = 3 "sysCall_nonSimulation",
    BeforeSimulation = 4 "sysCall_beforeSimulation",
    AfterSimulation = 5 "sysCall_afterSimulation",
    Actuation = 6 "sysCall_actuation",
    Sensing = 7 "sysCall_sensing",
    Suspended = 8 "sysCall_suspended",
    Suspend = 9 "sysCall_suspend",
    Resume = 10 "sysCall_resume",
    BeforeInstanceSwitch = 11 "sysCall_beforeInstanceSwitch",
    AfterInstanceSwitch = 12 "sysCall_afterInstanceSwitch",
    BeforeCopy = 13 "sysCall_beforeCopy",
    AfterCopy = 14 "sysCall_afterCopy",
    AddOnScriptSuspend = 16 "sysCall_addOnScriptSuspend",
    AddOnScriptResume = 17 "sysCall_addOnScriptResume",
    JointCallback = 18 "sysCall_jointCallback",
    ContactCallback = 19 "sysCall_contactCallback",
    BeforeDelete = 24 "sysCall_beforeDelete",
    AfterDelete = 25 "sysCall_afterDelete",
    AfterCreate = 26 "sysCall_afterCreate",
    DynCallback = 28 "sysCall_dynCallback",
    BeforeMainScript = 29 "sysCall_beforeMainScript",
    Vision = 30 "sysCall_vision",
    Trigger = 31 "sysCall_trigger",
    UserConfig = 32 "sysCall_userConfig",
    ModuleEntry = 33 "sysCall_moduleEntry",
    Event = 34 "sysCall_event",
    Ext = 35 "sysCall_ext",
    RealTimeIdle = 36 "sysCall_realTimeIdle",
    BeforeSave = 37 "sysCall_beforeSave",
    AfterSave = 38 "sysCall_afterSave",
    Msg = 39 "sysCall_msg",
    Dyn = 40 "sysCall_dyn",
    Contact = 41 "sysCall_contact",
    Joint = 42 "sysCall_joint",
    Thread = 43 "sysCall_thread",
    SelChange = 44 "sysCall_selChange",
    Data = 45 "sysCall_data",
    AfterLoad = 46 "sysCall_afterLoad",
}

impl SysCall {
    /// The callback with the function name `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|call| call.name() == name)
    }

    pub(crate) const fn bit(self) -> u64 {
        1 << self as u64
    }

    /// Whether this callback starts an unloaded script (spec: scripts 3).
    pub(crate) const fn wakes(self) -> bool {
        self as u8 <= Self::Sensing as u8
    }

    /// Whether threads are resumed before this callback. It is delivered to all scripts, also to those that define it late.
    pub(crate) const fn resumes_threads(self) -> bool {
        matches!(self, Self::Actuation | Self::NonSimulation)
    }

    /// Whether scripts need not be called that have nothing to do in it: callbacks without arguments, which come again and again.
    pub(crate) const fn may_be_idle(self) -> bool {
        matches!(
            self,
            Self::NonSimulation
                | Self::Actuation
                | Self::Sensing
                | Self::Suspended
                | Self::BeforeMainScript
                | Self::RealTimeIdle
        )
    }

    /// Whether all other scripts are notified when a script has run this.
    pub(crate) const fn is_announced(self) -> bool {
        matches!(
            self,
            Self::Init
                | Self::Cleanup
                | Self::AddOnScriptSuspend
                | Self::AddOnScriptResume
                | Self::UserConfig
        )
    }
}
