/*
 * Generated: UPDATE=1 cargo test --test repository generated.
 *
 * The C interface of native plugins for CoppeliaSim, as far as Swanilda has it: types, constants and functions. A plugin that was compiled
 * with CoppeliaSim's own headers runs as well; this one needs nothing else.
 *
 * One source file of the plugin defines SWANILDA_PLUGIN_IMPLEMENTATION before it includes this file. It exports simInit, which calls
 *     loadSimLibrary(info->coppeliaSimLibPath) and getSimProcAddresses(library)
 * before any other function, registers functions for scripts, and returns the version of the plugin, or 0 if it cannot run.
 *
 * Functions return -1, or NULL, if they fail; simGetLastError says why. Texts and arrays that they return are released with
 * simReleaseBuffer. Call them from the functions that the simulator calls only, never from threads of your own.
 * Handles are those of scripts; lengths are metres, angles radians, times seconds.
 */
#ifndef SWANILDA_PLUGIN_H
#define SWANILDA_PLUGIN_H

#include <stddef.h>
#ifndef __cplusplus
#include <stdbool.h>
#endif

#ifdef __cplusplus
#define SIM_DLLEXPORT extern "C" __attribute__((visibility("default")))
extern "C" {
#else
#define SIM_DLLEXPORT __attribute__((visibility("default")))
#endif

/* What simInit gets. */
typedef struct SSimInit {
    const char* pluginName;
    const char* coppeliaSimLibPath;
} SSimInit;

/* What simMsg gets: the kind of message, and numbers that belong to it. */
typedef struct SSimMsg {
    int msgId;
    int* auxData;
    void* auxPointer;
} SSimMsg;

/* What a function for scripts gets. Its arguments are on the stack; what is there when it returns are its results. */
typedef struct SScriptCallBack {
    int objectID;
    int scriptID;
    int stackID;
    char waitUntilZero;
    char* raiseErrorWithMessage;
    char* source;
    int line;
} SScriptCallBack;

/* Messages. */
enum {
    sim_message_eventcallback_scenesave = 260,
    sim_message_eventcallback_modelsave = 261,
    sim_message_eventcallback_instancepass = 269,
    sim_message_eventcallback_simulationabouttostart = 285,
    sim_message_eventcallback_simulationended = 286,
    sim_message_eventcallback_sceneloaded = 294,
    sim_message_eventcallback_modelloaded = 295,
    sim_message_eventcallback_simulationabouttoend = 334,
    sim_message_eventcallback_scriptstateabouttobedestroyed = 338,
    sim_message_eventcallback_simulationinit = 340,
    sim_message_eventcallback_simulationactuation = 341,
    sim_message_eventcallback_simulationsensing = 342,
    sim_message_eventcallback_simulationcleanup = 343
};

/* What simGetStackTableInfo returns for what is no list. */
enum { sim_stack_table_map = -2, sim_stack_table_not_table = -3 };

/* The constants of scripts: sim.handle_all is sim_handle_all. */
enum {
    sim_addonscriptcall_cleanup = 1,
    sim_addonscriptcall_initialization = 2,
    sim_addonscriptcall_restarting = 17,
    sim_addonscriptcall_run = 15,
    sim_addonscriptcall_suspend = 16,
    sim_api_error_output = 2,
    sim_api_error_report = 1,
    sim_api_warning_output = 4,
    sim_appflavor_edu = 1,
    sim_appflavor_lite = 0,
    sim_appflavor_pro = 2,
    sim_appobj_2delement_type = 116,
    sim_appobj_collection_type = 115,
    sim_appobj_collision_type = 110,
    sim_appobj_distance_type = 111,
    sim_appobj_ik_type = 113,
    sim_appobj_object_type = 109,
    sim_appobj_pathplanning_type = 118,
    sim_appobj_script_type = 117,
    sim_appobj_simulation_type = 112,
    sim_appobj_texture_type = 120,
    sim_appobj_ui_type = 116,
    sim_arrayparam_ambient_light = 5,
    sim_arrayparam_background_color1 = 3,
    sim_arrayparam_background_color2 = 4,
    sim_arrayparam_fog = 1,
    sim_arrayparam_fog_color = 2,
    sim_arrayparam_gravity = 0,
    sim_arrayparam_random_euler = 6,
    sim_arrayparam_raydirection = 8,
    sim_arrayparam_rayorigin = 7,
    sim_banner_backfaceculling = 512,
    sim_banner_bitmapfont = 2048,
    sim_banner_clickselectsparent = 32,
    sim_banner_clicktriggersevent = 64,
    sim_banner_facingcamera = 128,
    sim_banner_followparentvisibility = 16,
    sim_banner_fullyfacingcamera = 256,
    sim_banner_keepsamesize = 1024,
    sim_banner_left = 1,
    sim_banner_nobackground = 4,
    sim_banner_overlay = 8,
    sim_banner_right = 2,
    sim_boolparam_aux_clip_planes_enabled = 23,
    sim_boolparam_browser_toolbarbutton_enabled = 36,
    sim_boolparam_browser_visible = 12,
    sim_boolparam_calcmodules_toolbarbutton_enabled = 47,
    sim_boolparam_cansave = 60,
    sim_boolparam_collision_handling_enabled = 2,
    sim_boolparam_console_visible = 1,
    sim_boolparam_display_enabled = 16,
    sim_boolparam_distance_handling_enabled = 3,
    sim_boolparam_dynamics_handling_enabled = 6,
    sim_boolparam_execunsafe = 58,
    sim_boolparam_execunsafeext = 59,
    sim_boolparam_exit_request = 41,
    sim_boolparam_fog_enabled = 19,
    sim_boolparam_force_calcstruct_all = 40,
    sim_boolparam_force_calcstruct_all_visible = 39,
    sim_boolparam_force_show_wireless_emission = 27,
    sim_boolparam_force_show_wireless_reception = 28,
    sim_boolparam_full_model_copy_from_api = 24,
    sim_boolparam_fullscreen = 33,
    sim_boolparam_gcs_handling_enabled = 5,
    sim_boolparam_headless = 34,
    sim_boolparam_hierarchy_toolbarbutton_enabled = 35,
    sim_boolparam_hierarchy_visible = 0,
    sim_boolparam_ik_handling_enabled = 4,
    sim_boolparam_infotext_visible = 17,
    sim_boolparam_mill_handling_enabled = 11,
    sim_boolparam_mirrors_enabled = 22,
    sim_boolparam_objectrotate_toolbarbutton_enabled = 38,
    sim_boolparam_objectshift_toolbarbutton_enabled = 37,
    sim_boolparam_objproperties_toolbarbutton_enabled = 46,
    sim_boolparam_pause_toolbarbutton_enabled = 43,
    sim_boolparam_play_toolbarbutton_enabled = 42,
    sim_boolparam_proximity_sensor_handling_enabled = 9,
    sim_boolparam_rayvalid = 56,
    sim_boolparam_realtime_simulation = 25,
    sim_boolparam_rendering_sensor_handling_enabled = 10,
    sim_boolparam_rml2_available = 20,
    sim_boolparam_rml4_available = 21,
    sim_boolparam_rosinterface_donotrunmainscript = 48,
    sim_boolparam_scene_and_model_load_messages = 13,
    sim_boolparam_scene_closing = 52,
    sim_boolparam_shape_textures_are_visible = 15,
    sim_boolparam_show_w_emitters = 53,
    sim_boolparam_show_w_receivers = 54,
    sim_boolparam_statustext_open = 18,
    sim_boolparam_stop_toolbarbutton_enabled = 44,
    sim_boolparam_use_glfinish_cmd = 26,
    sim_boolparam_usingscriptobjects = 61,
    sim_boolparam_video_recording_triggered = 29,
    sim_boolparam_vision_sensor_handling_enabled = 10,
    sim_boolparam_waiting_for_trigger = 45,
    sim_buffer_base64 = 12,
    sim_buffer_clamp = 256,
    sim_buffer_double = 7,
    sim_buffer_float = 6,
    sim_buffer_int16 = 3,
    sim_buffer_int32 = 5,
    sim_buffer_int8 = 1,
    sim_buffer_split = 13,
    sim_buffer_uint16 = 2,
    sim_buffer_uint32 = 4,
    sim_buffer_uint8 = 0,
    sim_buffer_uint8argb = 11,
    sim_buffer_uint8bgr = 9,
    sim_buffer_uint8rgb = 8,
    sim_buffer_uint8rgba = 10,
    sim_bullet_body_angulardamping = 6005,
    sim_bullet_body_autoshrinkconvex = 8004,
    sim_bullet_body_bitcoded = 7001,
    sim_bullet_body_friction = 6003,
    sim_bullet_body_lineardamping = 6004,
    sim_bullet_body_nondefaultcollisionmargingfactor = 6006,
    sim_bullet_body_nondefaultcollisionmargingfactorconvex = 6007,
    sim_bullet_body_oldfriction = 6002,
    sim_bullet_body_restitution = 6001,
    sim_bullet_body_sticky = 8001,
    sim_bullet_body_usenondefaultcollisionmargin = 8002,
    sim_bullet_body_usenondefaultcollisionmarginconvex = 8003,
    sim_bullet_constraintsolvertype_dantzig = 2,
    sim_bullet_constraintsolvertype_nncg = 1,
    sim_bullet_constraintsolvertype_projectedgaussseidel = 3,
    sim_bullet_constraintsolvertype_sequentialimpulse = 0,
    sim_bullet_global_bitcoded = 1002,
    sim_bullet_global_collisionmarginfactor = 3,
    sim_bullet_global_computeinertias = 2002,
    sim_bullet_global_constraintsolvertype = 1003,
    sim_bullet_global_constraintsolvingiterations = 1001,
    sim_bullet_global_fullinternalscaling = 2001,
    sim_bullet_global_internalscalingfactor = 2,
    sim_bullet_global_stepsize = 1,
    sim_bullet_joint_normalcfm = 3003,
    sim_bullet_joint_pospid1 = 3006,
    sim_bullet_joint_pospid2 = 3007,
    sim_bullet_joint_pospid3 = 3008,
    sim_bullet_joint_stopcfm = 3002,
    sim_bullet_joint_stoperp = 3001,
    sim_buttonproperty_borderless = 32,
    sim_buttonproperty_button = 0,
    sim_buttonproperty_closeaction = 4096,
    sim_buttonproperty_downupevent = 16384,
    sim_buttonproperty_editbox = 3,
    sim_buttonproperty_enabled = 16,
    sim_buttonproperty_horizontallycentered = 64,
    sim_buttonproperty_ignoremouse = 128,
    sim_buttonproperty_isdown = 256,
    sim_buttonproperty_label = 1,
    sim_buttonproperty_nobackgroundcolor = 1024,
    sim_buttonproperty_rollupaction = 2048,
    sim_buttonproperty_slider = 2,
    sim_buttonproperty_staydown = 8,
    sim_buttonproperty_transparent = 512,
    sim_buttonproperty_verticallycentered = 8192,
    sim_callbackid_dynstep = 2,
    sim_callbackid_rossubscriber = 1,
    sim_callbackid_userdefined = 1000,
    sim_camerafarrayparam_viewfrustum = 9013,
    sim_camerafloatparam_far_clipping = 9009,
    sim_camerafloatparam_near_clipping = 9008,
    sim_camerafloatparam_ortho_size = 9002,
    sim_camerafloatparam_perspective_angle = 9001,
    sim_camerafloatparam_pov_aperture = 9006,
    sim_camerafloatparam_pov_blur_distance = 9005,
    sim_cameraintparam_disabled_light_components = 9000,
    sim_cameraintparam_perspective_operation = 9010,
    sim_cameraintparam_pov_blur_samples = 9007,
    sim_cameraintparam_pov_focal_blur = 9004,
    sim_cameraintparam_rendering_attributes = 9003,
    sim_cameraintparam_trackedobject = 9011,
    sim_childscriptattribute_automaticcascadingcalls = 3,
    sim_childscriptattribute_enabled = 4,
    sim_childscriptcall_actuation = 6,
    sim_childscriptcall_cleanup = 1,
    sim_childscriptcall_initialization = 2,
    sim_childscriptcall_sensing = 7,
    sim_colorcomponent_ambient = 0,
    sim_colorcomponent_ambient_diffuse = 0,
    sim_colorcomponent_auxiliary = 5,
    sim_colorcomponent_diffuse = 1,
    sim_colorcomponent_emission = 3,
    sim_colorcomponent_specular = 2,
    sim_colorcomponent_transparency = 4,
    sim_customizationscriptattribute_activeduringsimulation = 0,
    sim_customizationscriptattribute_cleanupbeforesave = 5,
    sim_customizationscriptcall_aftercopy = 14,
    sim_customizationscriptcall_beforecopy = 13,
    sim_customizationscriptcall_cleanup = 1,
    sim_customizationscriptcall_firstafterinstanceswitch = 12,
    sim_customizationscriptcall_firstaftersimulation = 5,
    sim_customizationscriptcall_initialization = 2,
    sim_customizationscriptcall_lastbeforeinstanceswitch = 11,
    sim_customizationscriptcall_lastbeforesimulation = 4,
    sim_customizationscriptcall_nonsimulation = 3,
    sim_customizationscriptcall_simulationactuation = 6,
    sim_customizationscriptcall_simulationpause = 8,
    sim_customizationscriptcall_simulationpausefirst = 9,
    sim_customizationscriptcall_simulationpauselast = 10,
    sim_customizationscriptcall_simulationsensing = 7,
    sim_displayattribute_colorcoded = 8192,
    sim_displayattribute_colorcodedpickpass = 4096,
    sim_displayattribute_colorcodedtriangles = 134217728,
    sim_displayattribute_depthpass = 2,
    sim_displayattribute_dynamiccontentonly = 131072,
    sim_displayattribute_forbidedges = 256,
    sim_displayattribute_forbidwireframe = 128,
    sim_displayattribute_forcewireframe = 64,
    sim_displayattribute_forvisionsensor = 2048,
    sim_displayattribute_ignorelayer = 1024,
    sim_displayattribute_ignorerenderableflag = 1048576,
    sim_displayattribute_mainselection = 32,
    sim_displayattribute_mirror = 262144,
    sim_displayattribute_nodrawingobjects = 33554432,
    sim_displayattribute_noghosts = 8388608,
    sim_displayattribute_noopenglcallbacks = 2097152,
    sim_displayattribute_noparticles = 67108864,
    sim_displayattribute_nopointclouds = 16777216,
    sim_displayattribute_originalcolors = 512,
    sim_displayattribute_pickpass = 4,
    sim_displayattribute_renderpass = 1,
    sim_displayattribute_selected = 8,
    sim_displayattribute_thickEdges = 65536,
    sim_displayattribute_trianglewireframe = 16384,
    sim_displayattribute_useauxcomponent = 524288,
    sim_distcalcmethod_dac = 1,
    sim_distcalcmethod_dac_if_nonzero = 6,
    sim_distcalcmethod_dl = 0,
    sim_distcalcmethod_dl_and_dac = 3,
    sim_distcalcmethod_dl_if_nonzero = 5,
    sim_distcalcmethod_max_dl_dac = 2,
    sim_distcalcmethod_sqrt_dl2_and_dac2 = 4,
    sim_dlgret_cancel = 2,
    sim_dlgret_no = 4,
    sim_dlgret_ok = 1,
    sim_dlgret_still_open = 0,
    sim_dlgret_yes = 3,
    sim_dlgstyle_dont_center = 32,
    sim_dlgstyle_input = 1,
    sim_dlgstyle_message = 0,
    sim_dlgstyle_ok = 2,
    sim_dlgstyle_ok_cancel = 3,
    sim_dlgstyle_yes_no = 4,
    sim_drawing_12percenttransparency = 32768,
    sim_drawing_25percenttransparency = 16384,
    sim_drawing_50percenttransparency = 8192,
    sim_drawing_auxchannelcolor1 = 2097152,
    sim_drawing_auxchannelcolor2 = 4194304,
    sim_drawing_backfaceculling = 256,
    sim_drawing_cubepoints = 6,
    sim_drawing_cubepts = 12,
    sim_drawing_cyclic = 4096,
    sim_drawing_discpoints = 5,
    sim_drawing_discpts = 11,
    sim_drawing_emissioncolor = 65536,
    sim_drawing_facingcamera = 131072,
    sim_drawing_followparentvisibility = 2048,
    sim_drawing_itemcolors = 32,
    sim_drawing_itemsizes = 128,
    sim_drawing_itemtransparency = 524288,
    sim_drawing_lines = 1,
    sim_drawing_linestrip = 8,
    sim_drawing_local = 8388608,
    sim_drawing_overlay = 262144,
    sim_drawing_painttag = 1024,
    sim_drawing_persistent = 1048576,
    sim_drawing_points = 0,
    sim_drawing_quadpoints = 4,
    sim_drawing_quadpts = 10,
    sim_drawing_spherepoints = 7,
    sim_drawing_spherepts = 7,
    sim_drawing_trianglepoints = 3,
    sim_drawing_trianglepts = 9,
    sim_drawing_triangles = 2,
    sim_drawing_vertexcolors = 64,
    sim_drawing_wireframe = 512,
    sim_dummy_linktype_dynamics_force_constraint = 1,
    sim_dummy_linktype_dynamics_loop_closure = 0,
    sim_dummy_linktype_gcs_loop_closure = 2,
    sim_dummy_linktype_gcs_target = 4,
    sim_dummy_linktype_gcs_tip = 3,
    sim_dummy_linktype_ik_tip_target = 5,
    sim_dummyfloatparam_follow_path_offset = 10002,
    sim_dummyfloatparam_size = 10003,
    sim_dummyintparam_dummytype = 10000,
    sim_dummyintparam_follow_path = 10001,
    sim_dummyintparam_link_type = 10000,
    sim_dummylink_dynloopclosure = 0,
    sim_dummylink_dyntendon = 7,
    sim_dummystringparam_assemblytag = 10004,
    sim_dummytype_assembly = 9,
    sim_dummytype_default = 8,
    sim_dummytype_dynloopclosure = 0,
    sim_dummytype_dyntendon = 7,
    sim_dynmat_default = 2310013,
    sim_dynmat_floor = 2310021,
    sim_dynmat_foot = 2310018,
    sim_dynmat_gripper = 2310020,
    sim_dynmat_highfriction = 2310014,
    sim_dynmat_lowfriction = 2310015,
    sim_dynmat_nofriction = 2310016,
    sim_dynmat_reststackgrasp = 2310017,
    sim_dynmat_wheel = 2310019,
    sim_filedlg_type_folder = 3,
    sim_filedlg_type_load = 0,
    sim_filedlg_type_load_multiple = 2,
    sim_filedlg_type_save = 1,
    sim_filtercomponent_3x3filter = 18,
    sim_filtercomponent_5x5filter = 19,
    sim_filtercomponent_addbuffer1 = 10,
    sim_filtercomponent_addtobuffer1 = 30,
    sim_filtercomponent_binary = 28,
    sim_filtercomponent_blobextraction = 34,
    sim_filtercomponent_circularcut = 23,
    sim_filtercomponent_colorsegmentation = 33,
    sim_filtercomponent_correlationwithbuffer1 = 32,
    sim_filtercomponent_customized = 1000,
    sim_filtercomponent_edge = 21,
    sim_filtercomponent_frombuffer1 = 7,
    sim_filtercomponent_frombuffer2 = 8,
    sim_filtercomponent_horizontalflip = 13,
    sim_filtercomponent_imagetocoord = 35,
    sim_filtercomponent_intensityscale = 25,
    sim_filtercomponent_keeporremovecolors = 26,
    sim_filtercomponent_multiplywithbuffer1 = 12,
    sim_filtercomponent_normalize = 24,
    sim_filtercomponent_originaldepth = 2,
    sim_filtercomponent_originalimage = 1,
    sim_filtercomponent_pixelchange = 36,
    sim_filtercomponent_rectangularcut = 22,
    sim_filtercomponent_resize = 17,
    sim_filtercomponent_rotate = 15,
    sim_filtercomponent_scaleandoffsetcolors = 27,
    sim_filtercomponent_sharpen = 20,
    sim_filtercomponent_shift = 16,
    sim_filtercomponent_subtractbuffer1 = 11,
    sim_filtercomponent_subtractfrombuffer1 = 31,
    sim_filtercomponent_swapbuffers = 9,
    sim_filtercomponent_swapwithbuffer1 = 29,
    sim_filtercomponent_tobuffer1 = 5,
    sim_filtercomponent_tobuffer2 = 6,
    sim_filtercomponent_todepthoutput = 38,
    sim_filtercomponent_tooutput = 4,
    sim_filtercomponent_uniformimage = 3,
    sim_filtercomponent_velodyne = 37,
    sim_filtercomponent_verticalflip = 14,
    sim_floatparam_dynamic_step_size = 3,
    sim_floatparam_maxtrisizeabs = 6,
    sim_floatparam_mintrisizerel = 7,
    sim_floatparam_mouse_wheel_zoom_factor = 4,
    sim_floatparam_physicstimestep = 5,
    sim_floatparam_rand = 0,
    sim_floatparam_simulation_time_step = 1,
    sim_floatparam_stereo_distance = 2,
    sim_forcefloatparam_error_a = 5003,
    sim_forcefloatparam_error_angle = 5007,
    sim_forcefloatparam_error_b = 5004,
    sim_forcefloatparam_error_g = 5005,
    sim_forcefloatparam_error_pos = 5006,
    sim_forcefloatparam_error_x = 5000,
    sim_forcefloatparam_error_y = 5001,
    sim_forcefloatparam_error_z = 5002,
    sim_graphintparam_needs_refresh = 10500,
    sim_handle_all = -2,
    sim_handle_all_except_explicit = -3,
    sim_handle_all_except_self = -10,
    sim_handle_app = -13,
    sim_handle_appstorage = -15,
    sim_handle_chain = -7,
    sim_handle_default = -9,
    sim_handle_inverse = -14,
    sim_handle_main_script = -5,
    sim_handle_mainscript = -5,
    sim_handle_mesh = -18,
    sim_handle_parent = -11,
    sim_handle_sandbox = -17,
    sim_handle_scene = -12,
    sim_handle_sceneobject = -16,
    sim_handle_self = -4,
    sim_handle_single = -8,
    sim_handle_tree = -6,
    sim_handle_world = -1,
    sim_handleflag_abscoords = 8388608,
    sim_handleflag_addmultiple = 16777216,
    sim_handleflag_altname = 4194304,
    sim_handleflag_assembly = 4194304,
    sim_handleflag_axis = 4194304,
    sim_handleflag_camera = 4194304,
    sim_handleflag_codedstring = 4194304,
    sim_handleflag_depthbuffer = 8388608,
    sim_handleflag_depthbuffermeters = 8388608,
    sim_handleflag_extended = 4194304,
    sim_handleflag_greyscale = 4194304,
    sim_handleflag_keeporiginal = 4194304,
    sim_handleflag_model = 8388608,
    sim_handleflag_rawvalue = 16777216,
    sim_handleflag_reljointbaseframe = 4194304,
    sim_handleflag_resetforce = 4194304,
    sim_handleflag_resetforcetorque = 12582912,
    sim_handleflag_resettorque = 8388608,
    sim_handleflag_setmultiple = 4194304,
    sim_handleflag_silenterror = 33554432,
    sim_handleflag_togglevisibility = 4194304,
    sim_handleflag_wxyzquat = 16777216,
    sim_headlessmode_disabled = 0,
    sim_headlessmode_emulated = 1,
    sim_headlessmode_enabled = 2,
    sim_ik_alpha_beta_constraint = 8,
    sim_ik_damped_least_squares_method = 1,
    sim_ik_gamma_constraint = 16,
    sim_ik_jacobian_transpose_method = 2,
    sim_ik_pseudo_inverse_method = 0,
    sim_ik_undamped_pseudo_inverse_method = 3,
    sim_ik_x_constraint = 1,
    sim_ik_y_constraint = 2,
    sim_ik_z_constraint = 4,
    sim_ikresult_fail = 2,
    sim_ikresult_not_performed = 0,
    sim_ikresult_success = 1,
    sim_imgcomb_horizontal = 1,
    sim_imgcomb_vertical = 0,
    sim_intparam_compilation_version = 4,
    sim_intparam_core_count = 24,
    sim_intparam_current_page = 5,
    sim_intparam_dlgverbosity = 42,
    sim_intparam_dynamic_engine = 8,
    sim_intparam_dynamic_iteration_count = 37,
    sim_intparam_dynamic_step_divider = 7,
    sim_intparam_dynamic_warning_disabled_mask = 32,
    sim_intparam_edit_mode_type = 14,
    sim_intparam_error_report_mode = 0,
    sim_intparam_exitcode = 44,
    sim_intparam_flymode_camera_handle = 6,
    sim_intparam_hierarchychangecounter = 50,
    sim_intparam_idle_fps = 26,
    sim_intparam_infotext_style = 12,
    sim_intparam_motionplanning_seed = 35,
    sim_intparam_mouse_buttons = 31,
    sim_intparam_mouse_x = 22,
    sim_intparam_mouse_y = 23,
    sim_intparam_mouseclickcounterdown = 46,
    sim_intparam_mouseclickcounterup = 47,
    sim_intparam_notifydeprecated = 51,
    sim_intparam_objectcreationcounter = 48,
    sim_intparam_objectdestructioncounter = 49,
    sim_intparam_platform = 19,
    sim_intparam_processcnt = 53,
    sim_intparam_processid = 52,
    sim_intparam_program_full_version = 39,
    sim_intparam_program_revision = 30,
    sim_intparam_program_version = 1,
    sim_intparam_prox_sensor_select_down = 27,
    sim_intparam_prox_sensor_select_up = 28,
    sim_intparam_qt_version = 16,
    sim_intparam_scene_index = 34,
    sim_intparam_scene_unique_id = 20,
    sim_intparam_server_port_next = 15,
    sim_intparam_server_port_range = 10,
    sim_intparam_server_port_start = 9,
    sim_intparam_settings = 13,
    sim_intparam_simulation_warning_disabled_mask = 33,
    sim_intparam_speedmodifier = 36,
    sim_intparam_statusbarverbosity = 41,
    sim_intparam_stop_request_counter = 29,
    sim_intparam_verbosity = 40,
    sim_intparam_videoencoderindex = 43,
    sim_intparam_visible_layers = 11,
    sim_intparam_work_thread_calc_time_ms = 25,
    sim_intparam_work_thread_count = 21,
    sim_joint_prismatic = 11,
    sim_joint_prismatic_subtype = 11,
    sim_joint_revolute = 10,
    sim_joint_revolute_subtype = 10,
    sim_joint_spherical = 12,
    sim_joint_spherical_subtype = 12,
    sim_jointdynctrl_callback = 16,
    sim_jointdynctrl_force = 1,
    sim_jointdynctrl_free = 0,
    sim_jointdynctrl_position = 8,
    sim_jointdynctrl_spring = 12,
    sim_jointdynctrl_velocity = 4,
    sim_jointfloatparam_error_a = 2025,
    sim_jointfloatparam_error_angle = 2029,
    sim_jointfloatparam_error_b = 2026,
    sim_jointfloatparam_error_g = 2027,
    sim_jointfloatparam_error_pos = 2028,
    sim_jointfloatparam_error_x = 2022,
    sim_jointfloatparam_error_y = 2023,
    sim_jointfloatparam_error_z = 2024,
    sim_jointfloatparam_ik_weight = 2021,
    sim_jointfloatparam_intrinsic_qw = 2011,
    sim_jointfloatparam_intrinsic_qx = 2008,
    sim_jointfloatparam_intrinsic_qy = 2009,
    sim_jointfloatparam_intrinsic_qz = 2010,
    sim_jointfloatparam_intrinsic_x = 2005,
    sim_jointfloatparam_intrinsic_y = 2006,
    sim_jointfloatparam_intrinsic_z = 2007,
    sim_jointfloatparam_kc_c = 2019,
    sim_jointfloatparam_kc_k = 2018,
    sim_jointfloatparam_maxaccel = 2037,
    sim_jointfloatparam_maxjerk = 2038,
    sim_jointfloatparam_maxvel = 2036,
    sim_jointfloatparam_pid_d = 2004,
    sim_jointfloatparam_pid_i = 2003,
    sim_jointfloatparam_pid_p = 2002,
    sim_jointfloatparam_screw_pitch = 2034,
    sim_jointfloatparam_screwlead = 2042,
    sim_jointfloatparam_spherical_qw = 2016,
    sim_jointfloatparam_spherical_qx = 2013,
    sim_jointfloatparam_spherical_qy = 2014,
    sim_jointfloatparam_spherical_qz = 2015,
    sim_jointfloatparam_step_size = 2035,
    sim_jointfloatparam_upper_limit = 2017,
    sim_jointfloatparam_velocity = 2012,
    sim_jointfloatparam_vortex_dep_multiplication = 2032,
    sim_jointfloatparam_vortex_dep_offset = 2033,
    sim_jointintparam_ctrl_enabled = 2001,
    sim_jointintparam_dynctrlmode = 2039,
    sim_jointintparam_dynposctrltype = 2041,
    sim_jointintparam_dynvelctrltype = 2040,
    sim_jointintparam_motor_enabled = 2000,
    sim_jointintparam_velocity_lock = 2030,
    sim_jointintparam_vortex_dep_handle = 2031,
    sim_jointmode_dependent = 4,
    sim_jointmode_dynamic = 5,
    sim_jointmode_force = 5,
    sim_jointmode_ik = 2,
    sim_jointmode_ikdependent = 3,
    sim_jointmode_kinematic = 0,
    sim_jointmode_passive = 0,
    sim_lang_lua = 0,
    sim_lang_python = 1,
    sim_lang_undefined = -1,
    sim_light_directional = 3,
    sim_light_directional_subtype = 3,
    sim_light_omnidirectional = 1,
    sim_light_omnidirectional_subtype = 1,
    sim_light_spot = 2,
    sim_light_spot_subtype = 2,
    sim_lightfloatparam_const_attenuation = 8003,
    sim_lightfloatparam_lin_attenuation = 8004,
    sim_lightfloatparam_quad_attenuation = 8005,
    sim_lightfloatparam_spot_cutoff = 8002,
    sim_lightfloatparam_spot_exponent = 8001,
    sim_lightintparam_pov_casts_shadows = 8000,
    sim_mainscriptcall_cleanup = 1,
    sim_mainscriptcall_initialization = 2,
    sim_mainscriptcall_regular = 6,
    sim_markeropts_cyclic = 2,
    sim_markeropts_local = 1,
    sim_markeropts_overlay = 4,
    sim_markertype_axes = 15,
    sim_markertype_cubes = 11,
    sim_markertype_custom = 13,
    sim_markertype_cylinders = 12,
    sim_markertype_discs = 10,
    sim_markertype_lines = 1,
    sim_markertype_points = 0,
    sim_markertype_spheres = 7,
    sim_markertype_squares = 9,
    sim_markertype_triangles = 2,
    sim_markertype_tubes = 14,
    sim_materialcomponent_diffuse = 0,
    sim_materialcomponent_emission = 3,
    sim_materialcomponent_lightdiffuse = 1,
    sim_materialcomponent_specular = 2,
    sim_message_bannerclicked = 7,
    sim_message_keypress = 6,
    sim_message_model_loaded = 4,
    sim_message_object_selection_changed = 2,
    sim_message_pick_select_down = 11,
    sim_message_prox_sensor_select_down = 9,
    sim_message_prox_sensor_select_up = 10,
    sim_message_scene_loaded = 8,
    sim_message_ui_button_state_change = 0,
    sim_mill_cone_subtype = 43,
    sim_mill_cylinder_subtype = 41,
    sim_mill_disc_subtype = 42,
    sim_mill_pyramid_subtype = 40,
    sim_millintparam_volume_type = 11000,
    sim_mirrorfloatparam_height = 12001,
    sim_mirrorfloatparam_reflectance = 12002,
    sim_mirrorfloatparam_width = 12000,
    sim_mirrorintparam_enable = 12003,
    sim_modelproperty_not_collidable = 1,
    sim_modelproperty_not_detectable = 8,
    sim_modelproperty_not_dynamic = 32,
    sim_modelproperty_not_measurable = 2,
    sim_modelproperty_not_model = 61440,
    sim_modelproperty_not_renderable = 4,
    sim_modelproperty_not_reset = 128,
    sim_modelproperty_not_respondable = 64,
    sim_modelproperty_not_showasinsidemodel = 1024,
    sim_modelproperty_not_visible = 256,
    sim_modelproperty_scripts_inactive = 512,
    sim_moduleinfo_builddatestr = 1,
    sim_moduleinfo_extversionint = 2,
    sim_moduleinfo_extversionstr = 0,
    sim_moduleinfo_statusbarverbosity = 4,
    sim_moduleinfo_verbosity = 3,
    sim_msgbox_buttons_ok = 0,
    sim_msgbox_buttons_okcancel = 3,
    sim_msgbox_buttons_yesno = 1,
    sim_msgbox_buttons_yesnocancel = 2,
    sim_msgbox_return_cancel = 0,
    sim_msgbox_return_error = 4,
    sim_msgbox_return_no = 1,
    sim_msgbox_return_ok = 3,
    sim_msgbox_return_yes = 2,
    sim_msgbox_type_critical = 3,
    sim_msgbox_type_info = 0,
    sim_msgbox_type_question = 1,
    sim_msgbox_type_warning = 2,
    sim_mujoco_body_condim = 44001,
    sim_mujoco_body_friction1 = 43001,
    sim_mujoco_body_friction2 = 43002,
    sim_mujoco_body_friction3 = 43003,
    sim_mujoco_body_margin = 43012,
    sim_mujoco_body_priority = 44002,
    sim_mujoco_body_solimp1 = 43006,
    sim_mujoco_body_solimp2 = 43007,
    sim_mujoco_body_solimp3 = 43008,
    sim_mujoco_body_solimp4 = 43009,
    sim_mujoco_body_solimp5 = 43010,
    sim_mujoco_body_solmix = 43011,
    sim_mujoco_body_solref1 = 43004,
    sim_mujoco_body_solref2 = 43005,
    sim_mujoco_dummy_bitcoded = 47001,
    sim_mujoco_dummy_damping = 46013,
    sim_mujoco_dummy_limited = 48001,
    sim_mujoco_dummy_margin = 46010,
    sim_mujoco_dummy_proxyjointid = 47002,
    sim_mujoco_dummy_range1 = 46001,
    sim_mujoco_dummy_range2 = 46002,
    sim_mujoco_dummy_solimplimit1 = 46005,
    sim_mujoco_dummy_solimplimit2 = 46006,
    sim_mujoco_dummy_solimplimit3 = 46007,
    sim_mujoco_dummy_solimplimit4 = 46008,
    sim_mujoco_dummy_solimplimit5 = 46009,
    sim_mujoco_dummy_solreflimit1 = 46003,
    sim_mujoco_dummy_solreflimit2 = 46004,
    sim_mujoco_dummy_springlength = 46011,
    sim_mujoco_dummy_stiffness = 46012,
    sim_mujoco_global_balanceinertias = 39004,
    sim_mujoco_global_bitcoded = 38001,
    sim_mujoco_global_boundinertia = 37009,
    sim_mujoco_global_boundmass = 37008,
    sim_mujoco_global_computeinertias = 39001,
    sim_mujoco_global_cone = 38007,
    sim_mujoco_global_density = 37006,
    sim_mujoco_global_impratio = 37002,
    sim_mujoco_global_integrator = 38003,
    sim_mujoco_global_iterations = 38002,
    sim_mujoco_global_kininertia = 37019,
    sim_mujoco_global_kinmass = 37018,
    sim_mujoco_global_multiccd = 39003,
    sim_mujoco_global_multithreaded = 39002,
    sim_mujoco_global_nconmax = 38006,
    sim_mujoco_global_njmax = 38005,
    sim_mujoco_global_nstack = 38009,
    sim_mujoco_global_overridecontacts = 39005,
    sim_mujoco_global_overridekin = 38008,
    sim_mujoco_global_overridemargin = 37010,
    sim_mujoco_global_overridesolimp1 = 37013,
    sim_mujoco_global_overridesolimp2 = 37014,
    sim_mujoco_global_overridesolimp3 = 37015,
    sim_mujoco_global_overridesolimp4 = 37016,
    sim_mujoco_global_overridesolimp5 = 37017,
    sim_mujoco_global_overridesolref1 = 37011,
    sim_mujoco_global_overridesolref2 = 37012,
    sim_mujoco_global_rebuildtrigger = 38010,
    sim_mujoco_global_solver = 38004,
    sim_mujoco_global_viscosity = 37007,
    sim_mujoco_global_wind1 = 37003,
    sim_mujoco_global_wind2 = 37004,
    sim_mujoco_global_wind3 = 37005,
    sim_mujoco_joint_armature = 40021,
    sim_mujoco_joint_damping = 40017,
    sim_mujoco_joint_dependentobjectid = 41002,
    sim_mujoco_joint_frictionloss = 40008,
    sim_mujoco_joint_margin = 40022,
    sim_mujoco_joint_polycoef1 = 40023,
    sim_mujoco_joint_polycoef2 = 40024,
    sim_mujoco_joint_polycoef3 = 40025,
    sim_mujoco_joint_polycoef4 = 40026,
    sim_mujoco_joint_polycoef5 = 40027,
    sim_mujoco_joint_pospid1 = 40028,
    sim_mujoco_joint_pospid2 = 40029,
    sim_mujoco_joint_pospid3 = 40030,
    sim_mujoco_joint_solimpfriction1 = 40011,
    sim_mujoco_joint_solimpfriction2 = 40012,
    sim_mujoco_joint_solimpfriction3 = 40013,
    sim_mujoco_joint_solimpfriction4 = 40014,
    sim_mujoco_joint_solimpfriction5 = 40015,
    sim_mujoco_joint_solimplimit1 = 40003,
    sim_mujoco_joint_solimplimit2 = 40004,
    sim_mujoco_joint_solimplimit3 = 40005,
    sim_mujoco_joint_solimplimit4 = 40006,
    sim_mujoco_joint_solimplimit5 = 40007,
    sim_mujoco_joint_solreffriction1 = 40009,
    sim_mujoco_joint_solreffriction2 = 40010,
    sim_mujoco_joint_solreflimit1 = 40001,
    sim_mujoco_joint_solreflimit2 = 40002,
    sim_mujoco_joint_springdamper1 = 40019,
    sim_mujoco_joint_springdamper2 = 40020,
    sim_mujoco_joint_springref = 40018,
    sim_mujoco_joint_stiffness = 40016,
    sim_navigation_cameraangle = 5,
    sim_navigation_camerafly = 6,
    sim_navigation_camerarotate = 2,
    sim_navigation_camerarotatemiddlebutton = 8192,
    sim_navigation_camerarotaterightbutton = 8192,
    sim_navigation_camerashift = 1,
    sim_navigation_cameratilt = 4,
    sim_navigation_camerazoom = 3,
    sim_navigation_camerazoomwheel = 4096,
    sim_navigation_clickselection = 512,
    sim_navigation_createpathpoint = 256,
    sim_navigation_ctrlselection = 1024,
    sim_navigation_objectrotate = 8,
    sim_navigation_objectshift = 7,
    sim_navigation_passive = 0,
    sim_navigation_shiftselection = 2048,
    sim_newton_body_angulardrag = 33005,
    sim_newton_body_bitcoded = 34001,
    sim_newton_body_fastmoving = 35001,
    sim_newton_body_kineticfriction = 33002,
    sim_newton_body_lineardrag = 33004,
    sim_newton_body_restitution = 33003,
    sim_newton_body_staticfriction = 33001,
    sim_newton_global_bitcoded = 28002,
    sim_newton_global_computeinertias = 29004,
    sim_newton_global_constraintsolvingiterations = 28001,
    sim_newton_global_contactmergetolerance = 27002,
    sim_newton_global_exactsolver = 29002,
    sim_newton_global_highjointaccuracy = 29003,
    sim_newton_global_multithreading = 29001,
    sim_newton_global_stepsize = 27001,
    sim_newton_joint_dependencyfactor = 30001,
    sim_newton_joint_dependencyoffset = 30002,
    sim_newton_joint_dependentobjectid = 31002,
    sim_newton_joint_objectid = 31001,
    sim_newton_joint_pospid1 = 30003,
    sim_newton_joint_pospid2 = 30004,
    sim_newton_joint_pospid3 = 30005,
    sim_object_camera_type = 3,
    sim_object_collectionend = 2010000,
    sim_object_collectionstart = 2000000,
    sim_object_customappend = 7999999,
    sim_object_customappstart = 7001000,
    sim_object_customclassstart = 7000000,
    sim_object_customend = 9999999,
    sim_object_customsceneend = 9999999,
    sim_object_customscenestart = 8000000,
    sim_object_customstart = 7000000,
    sim_object_detachedscriptend = 1019999,
    sim_object_detachedscriptstart = 1010000,
    sim_object_drawingend = 3999999,
    sim_object_drawingstart = 2280010,
    sim_object_dummy_type = 4,
    sim_object_forcesensor_type = 12,
    sim_object_graph_type = 2,
    sim_object_joint_type = 1,
    sim_object_light_type = 13,
    sim_object_mill_type = 11,
    sim_object_mirror_type = 14,
    sim_object_no_subtype = 200,
    sim_object_octree_type = 15,
    sim_object_path_type = 8,
    sim_object_pointcloud_type = 16,
    sim_object_proximitysensor_type = 5,
    sim_object_renderingsensor_type = 9,
    sim_object_sceneobjectend = 999999,
    sim_object_sceneobjectstart = 0,
    sim_object_script_type = 17,
    sim_object_shape_type = 0,
    sim_object_stackend = 1029999,
    sim_object_stackstart = 1020000,
    sim_object_textureend = 2280009,
    sim_object_texturestart = 2180009,
    sim_object_variousstart = 10000000,
    sim_object_visionsensor_type = 9,
    sim_objectproperty_cannotdelete = 8192,
    sim_objectproperty_cannotdeleteduringsim = 16384,
    sim_objectproperty_canupdatedna = 1024,
    sim_objectproperty_collapsed = 16,
    sim_objectproperty_depthinvisible = 4096,
    sim_objectproperty_dontshowasinsidemodel = 256,
    sim_objectproperty_hiddenforsimulation = 65536,
    sim_objectproperty_hierarchyhiddenmodelchild = 32768,
    sim_objectproperty_ignoreviewfitting = 1,
    sim_objectproperty_selectable = 32,
    sim_objectproperty_selectinvisible = 2048,
    sim_objectproperty_selectmodelbaseinstead = 128,
    sim_objectspecialproperty_collidable = 1,
    sim_objectspecialproperty_detectable = 496,
    sim_objectspecialproperty_detectable_all = 496,
    sim_objectspecialproperty_detectable_capacitive = 256,
    sim_objectspecialproperty_detectable_inductive = 128,
    sim_objectspecialproperty_detectable_infrared = 32,
    sim_objectspecialproperty_detectable_laser = 64,
    sim_objectspecialproperty_detectable_ultrasonic = 16,
    sim_objectspecialproperty_measurable = 2,
    sim_objectspecialproperty_pathplanning_ignored = 2048,
    sim_objectspecialproperty_renderable = 512,
    sim_objecttype_app = 126,
    sim_objecttype_collection = 115,
    sim_objecttype_customobject = 125,
    sim_objecttype_detachedscript = 117,
    sim_objecttype_interfacestack = 123,
    sim_objecttype_mesh = 122,
    sim_objecttype_scene = 127,
    sim_objecttype_sceneobject = 109,
    sim_objecttype_script = 117,
    sim_objecttype_texture = 120,
    sim_objfloatparam_abs_rot_velocity = 14,
    sim_objfloatparam_abs_x_velocity = 11,
    sim_objfloatparam_abs_y_velocity = 12,
    sim_objfloatparam_abs_z_velocity = 13,
    sim_objfloatparam_modelbbox_max_x = 24,
    sim_objfloatparam_modelbbox_max_y = 25,
    sim_objfloatparam_modelbbox_max_z = 26,
    sim_objfloatparam_modelbbox_min_x = 21,
    sim_objfloatparam_modelbbox_min_y = 22,
    sim_objfloatparam_modelbbox_min_z = 23,
    sim_objfloatparam_objbbox_max_x = 18,
    sim_objfloatparam_objbbox_max_y = 19,
    sim_objfloatparam_objbbox_max_z = 20,
    sim_objfloatparam_objbbox_min_x = 15,
    sim_objfloatparam_objbbox_min_y = 16,
    sim_objfloatparam_objbbox_min_z = 17,
    sim_objfloatparam_size_factor = 34,
    sim_objfloatparam_transparency_offset = 28,
    sim_objintparam_child_role = 29,
    sim_objintparam_collection_self_collision_indicator = 27,
    sim_objintparam_hierarchycolor = 38,
    sim_objintparam_illumination_handle = 32,
    sim_objintparam_manipulation_permissions = 31,
    sim_objintparam_parent_role = 30,
    sim_objintparam_unique_id = 37,
    sim_objintparam_visibility_layer = 10,
    sim_objintparam_visible = 36,
    sim_objstringparam_dna = 33,
    sim_objstringparam_unique_id = 35,
    sim_octreefloatparam_voxelsize = 13000,
    sim_ode_body_angulardamping = 15005,
    sim_ode_body_friction = 15001,
    sim_ode_body_lineardamping = 15004,
    sim_ode_body_maxcontacts = 16001,
    sim_ode_body_softcfm = 15003,
    sim_ode_body_softerp = 15002,
    sim_ode_global_bitcoded = 10002,
    sim_ode_global_cfm = 9003,
    sim_ode_global_computeinertias = 11003,
    sim_ode_global_constraintsolvingiterations = 10001,
    sim_ode_global_erp = 9004,
    sim_ode_global_fullinternalscaling = 11001,
    sim_ode_global_internalscalingfactor = 9002,
    sim_ode_global_quickstep = 11002,
    sim_ode_global_randomseed = 10003,
    sim_ode_global_stepsize = 9001,
    sim_ode_joint_bounce = 12003,
    sim_ode_joint_fudgefactor = 12004,
    sim_ode_joint_normalcfm = 12005,
    sim_ode_joint_pospid1 = 12006,
    sim_ode_joint_pospid2 = 12007,
    sim_ode_joint_pospid3 = 12008,
    sim_ode_joint_stopcfm = 12002,
    sim_ode_joint_stoperp = 12001,
    sim_parentingmode_assembly = 2,
    sim_parentingmode_keeplocalpose = 0,
    sim_parentingmode_keepworldpose = 1,
    sim_particle_cyclic = 8192,
    sim_particle_emissioncolor = 16384,
    sim_particle_ignoresgravity = 256,
    sim_particle_invisible = 512,
    sim_particle_itemcolors = 4096,
    sim_particle_itemdensities = 2048,
    sim_particle_itemsizes = 1024,
    sim_particle_painttag = 65536,
    sim_particle_particlerespondable = 128,
    sim_particle_points1 = 0,
    sim_particle_points2 = 1,
    sim_particle_points4 = 2,
    sim_particle_respondable1to4 = 32,
    sim_particle_respondable5to8 = 64,
    sim_particle_roughspheres = 3,
    sim_particle_spheres = 4,
    sim_particle_water = 32768,
    sim_pathproperty_automatic_orientation = 8,
    sim_pathproperty_closed_path = 4,
    sim_pathproperty_flat_path = 64,
    sim_pathproperty_keep_x_up = 2048,
    sim_pathproperty_show_line = 1,
    sim_pathproperty_show_orientation = 2,
    sim_pathproperty_show_position = 128,
    sim_physics_bullet = 0,
    sim_physics_drake = 5,
    sim_physics_mujoco = 4,
    sim_physics_newton = 3,
    sim_physics_ode = 1,
    sim_physics_physx = 5,
    sim_physics_vortex = 2,
    sim_platform_linux = 2,
    sim_platform_macos = 1,
    sim_platform_windows = 0,
    sim_plugininfo_builddatestr = 1,
    sim_plugininfo_extversionint = 2,
    sim_plugininfo_extversionstr = 0,
    sim_plugininfo_statusbarverbosity = 4,
    sim_plugininfo_verbosity = 3,
    sim_primitiveshape_capsule = 8,
    sim_primitiveshape_cone = 6,
    sim_primitiveshape_cuboid = 3,
    sim_primitiveshape_cylinder = 5,
    sim_primitiveshape_disc = 2,
    sim_primitiveshape_heightfield = 7,
    sim_primitiveshape_none = 0,
    sim_primitiveshape_plane = 1,
    sim_primitiveshape_spheroid = 4,
    sim_propertyinfo_constant = 64,
    sim_propertyinfo_deprecated = 16,
    sim_propertyinfo_largedata = 256,
    sim_propertyinfo_modelhashexclude = 8,
    sim_propertyinfo_notreadable = 2,
    sim_propertyinfo_notwritable = 1,
    sim_propertyinfo_removable = 4,
    sim_propertyinfo_silent = 32,
    sim_propertytype_array = 19,
    sim_propertytype_bool = 0,
    sim_propertytype_buffer = 4,
    sim_propertytype_color = 10,
    sim_propertytype_color3 = 10,
    sim_propertytype_enum = 25,
    sim_propertytype_float = 2,
    sim_propertytype_floatarray = 11,
    sim_propertytype_group = 24,
    sim_propertytype_handle = 21,
    sim_propertytype_handlearray = 22,
    sim_propertytype_int = 1,
    sim_propertytype_intarray = 13,
    sim_propertytype_intarray2 = 15,
    sim_propertytype_long = 16,
    sim_propertytype_map = 20,
    sim_propertytype_matrix = 18,
    sim_propertytype_matrix3x3 = 8,
    sim_propertytype_matrix4x4 = 9,
    sim_propertytype_method = 240,
    sim_propertytype_null = 17,
    sim_propertytype_object = 224,
    sim_propertytype_objectarray = 225,
    sim_propertytype_objectmap = 226,
    sim_propertytype_pose = 7,
    sim_propertytype_quaternion = 6,
    sim_propertytype_string = 3,
    sim_propertytype_stringarray = 23,
    sim_propertytype_table = 12,
    sim_propertytype_vector2 = 14,
    sim_propertytype_vector3 = 5,
    sim_proximitysensor_cone = 33,
    sim_proximitysensor_cone_subtype = 33,
    sim_proximitysensor_cylinder = 31,
    sim_proximitysensor_cylinder_subtype = 31,
    sim_proximitysensor_disc = 32,
    sim_proximitysensor_disc_subtype = 32,
    sim_proximitysensor_pyramid = 30,
    sim_proximitysensor_pyramid_subtype = 30,
    sim_proximitysensor_ray = 34,
    sim_proximitysensor_ray_subtype = 34,
    sim_proxintparam_entity_to_detect = 4002,
    sim_proxintparam_ray_invisibility = 4000,
    sim_proxintparam_volume_type = 4001,
    sim_pure_primitive_cone = 6,
    sim_pure_primitive_cuboid = 3,
    sim_pure_primitive_cylinder = 5,
    sim_pure_primitive_disc = 2,
    sim_pure_primitive_heightfield = 7,
    sim_pure_primitive_none = 0,
    sim_pure_primitive_plane = 1,
    sim_pure_primitive_spheroid = 4,
    sim_rml_disable_extremum_motion_states_calc = 0,
    sim_rml_keep_current_vel_if_fallback_strategy = 0,
    sim_rml_keep_target_vel = 0,
    sim_rml_no_sync = 3,
    sim_rml_only_phase_sync = 1,
    sim_rml_only_time_sync = 1,
    sim_rml_phase_sync_if_possible = 0,
    sim_rml_recompute_trajectory = 0,
    sim_ruckig_minaccel = 512,
    sim_ruckig_minvel = 256,
    sim_ruckig_nosync = 3,
    sim_ruckig_phasesync = 0,
    sim_ruckig_timesync = 1,
    sim_sceneobject_camera = 3,
    sim_sceneobject_customsceneobject = 19,
    sim_sceneobject_dummy = 4,
    sim_sceneobject_forcesensor = 12,
    sim_sceneobject_graph = 2,
    sim_sceneobject_joint = 1,
    sim_sceneobject_light = 13,
    sim_sceneobject_marker = 18,
    sim_sceneobject_mill = 11,
    sim_sceneobject_mirror = 14,
    sim_sceneobject_octree = 15,
    sim_sceneobject_path = 8,
    sim_sceneobject_pointcloud = 16,
    sim_sceneobject_proximitysensor = 5,
    sim_sceneobject_renderingsensor = 9,
    sim_sceneobject_script = 17,
    sim_sceneobject_shape = 0,
    sim_sceneobject_visionsensor = 9,
    sim_script_call_error = 16,
    sim_script_lua_error = 8,
    sim_script_main_not_called = 2,
    sim_script_main_script_nonexistent = 1,
    sim_script_no_error = 0,
    sim_script_reentrance_error = 4,
    sim_scriptattribute_debuglevel = 6,
    sim_scriptattribute_enabled = 4,
    sim_scriptattribute_executioncount = 2,
    sim_scriptattribute_executionorder = 1,
    sim_scriptattribute_scripthandle = 8,
    sim_scriptattribute_scripttype = 7,
    sim_scriptdebug_allcalls = 3,
    sim_scriptdebug_callsandvars = 5,
    sim_scriptdebug_none = 0,
    sim_scriptdebug_syscalls = 1,
    sim_scriptdebug_vars = 4,
    sim_scriptdebug_vars_interval = 2,
    sim_scriptexecorder_first = 0,
    sim_scriptexecorder_last = 2,
    sim_scriptexecorder_normal = 1,
    sim_scriptintparam_autorestartonerror = 10107,
    sim_scriptintparam_enabled = 10104,
    sim_scriptintparam_execcount = 10101,
    sim_scriptintparam_execorder = 10100,
    sim_scriptintparam_handle = 10103,
    sim_scriptintparam_lang = 10106,
    sim_scriptintparam_objecthandle = 10105,
    sim_scriptintparam_type = 10102,
    sim_scriptstate_ended = 3,
    sim_scriptstate_error = 8,
    sim_scriptstate_initialized = 2,
    sim_scriptstate_suspended = 16,
    sim_scriptstate_uninitialized = 1,
    sim_scriptstate_unloaded = 0,
    sim_scriptstringparam_description = 10108,
    sim_scriptstringparam_lang = 10112,
    sim_scriptstringparam_name = 10109,
    sim_scriptstringparam_nameext = 10111,
    sim_scriptstringparam_text = 10110,
    sim_scripttype_addon = 2,
    sim_scripttype_addonfunction = 3,
    sim_scripttype_addonscript = 2,
    sim_scripttype_childscript = 1,
    sim_scripttype_customization = 6,
    sim_scripttype_customizationscript = 6,
    sim_scripttype_main = 0,
    sim_scripttype_mainscript = 0,
    sim_scripttype_passive = 9,
    sim_scripttype_sandbox = 8,
    sim_scripttype_sandboxscript = 8,
    sim_scripttype_simulation = 1,
    sim_scripttype_threaded = 33008,
    sim_shape_compound = 21,
    sim_shape_multishape_subtype = 21,
    sim_shape_simple = 20,
    sim_shape_simpleshape_subtype = 20,
    sim_shapefloatparam_edge_angle = 3026,
    sim_shapefloatparam_init_ang_velocity_x = 3020,
    sim_shapefloatparam_init_ang_velocity_y = 3021,
    sim_shapefloatparam_init_ang_velocity_z = 3022,
    sim_shapefloatparam_init_velocity_a = 3020,
    sim_shapefloatparam_init_velocity_b = 3021,
    sim_shapefloatparam_init_velocity_g = 3022,
    sim_shapefloatparam_init_velocity_x = 3000,
    sim_shapefloatparam_init_velocity_y = 3001,
    sim_shapefloatparam_init_velocity_z = 3002,
    sim_shapefloatparam_mass = 3005,
    sim_shapefloatparam_shading_angle = 3025,
    sim_shapefloatparam_texture_a = 3009,
    sim_shapefloatparam_texture_b = 3010,
    sim_shapefloatparam_texture_g = 3011,
    sim_shapefloatparam_texture_scaling_x = 3012,
    sim_shapefloatparam_texture_scaling_y = 3013,
    sim_shapefloatparam_texture_x = 3006,
    sim_shapefloatparam_texture_y = 3007,
    sim_shapefloatparam_texture_z = 3008,
    sim_shapeintparam_component_cnt = 3028,
    sim_shapeintparam_compound = 3016,
    sim_shapeintparam_convex = 3017,
    sim_shapeintparam_convex_check = 3018,
    sim_shapeintparam_culling = 3014,
    sim_shapeintparam_edge_borders_hidden = 3027,
    sim_shapeintparam_edge_visibility = 3024,
    sim_shapeintparam_kinematic = 3030,
    sim_shapeintparam_respondable = 3004,
    sim_shapeintparam_respondable_mask = 3019,
    sim_shapeintparam_respondablesuspendcnt = 3031,
    sim_shapeintparam_sleepmodestart = 3029,
    sim_shapeintparam_static = 3003,
    sim_shapeintparam_wireframe = 3015,
    sim_shapestringparam_color_name = 3023,
    sim_shapestringparam_colorname = 3032,
    sim_sim_lang_lua = 0,
    sim_sim_lang_python = 1,
    sim_sim_lang_undefined = -1,
    sim_simulation_advancing = 16,
    sim_simulation_advancing_abouttostop = 21,
    sim_simulation_advancing_firstafterpause = 20,
    sim_simulation_advancing_firstafterstop = 16,
    sim_simulation_advancing_lastbeforepause = 19,
    sim_simulation_advancing_lastbeforestop = 22,
    sim_simulation_advancing_running = 17,
    sim_simulation_lastbeforestop = 22,
    sim_simulation_paused = 8,
    sim_simulation_running = 17,
    sim_simulation_stopped = 0,
    sim_stackitem_bool = 2,
    sim_stackitem_color = 14,
    sim_stackitem_double = 1,
    sim_stackitem_func = 5,
    sim_stackitem_handle = 13,
    sim_stackitem_handlearray = 15,
    sim_stackitem_integer = 9,
    sim_stackitem_lightuserdat = 8,
    sim_stackitem_matrix = 10,
    sim_stackitem_null = 0,
    sim_stackitem_pose = 12,
    sim_stackitem_quaternion = 11,
    sim_stackitem_string = 3,
    sim_stackitem_table = 4,
    sim_stackitem_thread = 7,
    sim_stackitem_userdat = 6,
    sim_stream_transf_cumulative = 3,
    sim_stream_transf_derivative = 1,
    sim_stream_transf_integral = 2,
    sim_stream_transf_raw = 0,
    sim_stringparam_additionalpythonpath = 135,
    sim_stringparam_addondir = 143,
    sim_stringparam_addonpath = 131,
    sim_stringparam_app_arg1 = 2,
    sim_stringparam_app_arg2 = 3,
    sim_stringparam_app_arg3 = 4,
    sim_stringparam_app_arg4 = 5,
    sim_stringparam_app_arg5 = 6,
    sim_stringparam_app_arg6 = 7,
    sim_stringparam_app_arg7 = 8,
    sim_stringparam_app_arg8 = 9,
    sim_stringparam_app_arg9 = 10,
    sim_stringparam_application_path = 0,
    sim_stringparam_datadir = 129,
    sim_stringparam_defaultpython = 134,
    sim_stringparam_dlgverbosity = 123,
    sim_stringparam_importexportdir = 130,
    sim_stringparam_legacymachinetag = 142,
    sim_stringparam_logfilter = 124,
    sim_stringparam_luadir = 136,
    sim_stringparam_machine_id = 119,
    sim_stringparam_machine_id_legacy = 120,
    sim_stringparam_modeldefaultdir = 133,
    sim_stringparam_mujocodir = 138,
    sim_stringparam_pythondir = 137,
    sim_stringparam_remoteapi_temp_file_dir = 16,
    sim_stringparam_resourcesdir = 141,
    sim_stringparam_sandboxlang = 144,
    sim_stringparam_scene_name = 15,
    sim_stringparam_scene_path = 14,
    sim_stringparam_scene_path_and_name = 13,
    sim_stringparam_scene_unique_id = 118,
    sim_stringparam_scenedefaultdir = 132,
    sim_stringparam_statusbarverbosity = 122,
    sim_stringparam_systemdir = 140,
    sim_stringparam_tempdir = 127,
    sim_stringparam_tempscenedir = 128,
    sim_stringparam_uniqueid = 126,
    sim_stringparam_usersettingsdir = 139,
    sim_stringparam_verbosity = 121,
    sim_stringparam_video_filename = 1,
    sim_syscb_actuation = 6,
    sim_syscb_aftercopy = 14,
    sim_syscb_aftercreate = 26,
    sim_syscb_afterdelete = 25,
    sim_syscb_afterinstanceswitch = 12,
    sim_syscb_aftersimulation = 5,
    sim_syscb_aos_resume = 17,
    sim_syscb_aos_run = 15,
    sim_syscb_aos_suspend = 16,
    sim_syscb_beforecopy = 13,
    sim_syscb_beforedelete = 24,
    sim_syscb_beforeinstanceswitch = 11,
    sim_syscb_beforemainscript = 29,
    sim_syscb_beforesimulation = 4,
    sim_syscb_cleanup = 1,
    sim_syscb_contact = 41,
    sim_syscb_contactcallback = 19,
    sim_syscb_customcallback1 = 20,
    sim_syscb_customcallback2 = 21,
    sim_syscb_customcallback3 = 22,
    sim_syscb_customcallback4 = 23,
    sim_syscb_data = 45,
    sim_syscb_dyn = 40,
    sim_syscb_dyncallback = 28,
    sim_syscb_init = 2,
    sim_syscb_joint = 42,
    sim_syscb_jointcallback = 18,
    sim_syscb_moduleentry = 33,
    sim_syscb_nonsimulation = 3,
    sim_syscb_regular = 6,
    sim_syscb_resume = 10,
    sim_syscb_selchange = 44,
    sim_syscb_sensing = 7,
    sim_syscb_suspend = 9,
    sim_syscb_suspended = 8,
    sim_syscb_thread = 43,
    sim_syscb_trigger = 31,
    sim_syscb_userconfig = 32,
    sim_syscb_vision = 30,
    sim_textureapplymode_add = 2,
    sim_textureapplymode_decal = 1,
    sim_textureapplymode_modulate = 0,
    sim_texturemap_cube = 3,
    sim_texturemap_cylinder = 1,
    sim_texturemap_plane = 0,
    sim_texturemap_sphere = 2,
    sim_ui_property_fixedwidthfont = 16,
    sim_ui_property_moveable = 2,
    sim_ui_property_relativetoleftborder = 4,
    sim_ui_property_relativetotopborder = 8,
    sim_ui_property_rolledup = 128,
    sim_ui_property_selectassociatedobject = 256,
    sim_ui_property_settocenter = 64,
    sim_ui_property_systemblock = 32,
    sim_ui_property_visible = 1,
    sim_ui_property_visiblewhenobjectselected = 512,
    sim_verbosity_debug = 600,
    sim_verbosity_default = 400,
    sim_verbosity_errors = 200,
    sim_verbosity_infos = 500,
    sim_verbosity_loadinfos = 400,
    sim_verbosity_msgs = 450,
    sim_verbosity_none = 100,
    sim_verbosity_once = 131072,
    sim_verbosity_onlyterminal = 65536,
    sim_verbosity_questions = 410,
    sim_verbosity_scripterrors = 420,
    sim_verbosity_scriptinfos = 450,
    sim_verbosity_scriptwarnings = 430,
    sim_verbosity_trace = 700,
    sim_verbosity_traceall = 900,
    sim_verbosity_tracelua = 800,
    sim_verbosity_undecorated = 61440,
    sim_verbosity_useglobal = -1,
    sim_verbosity_warnings = 300,
    sim_version = 1,
    sim_visionfarrayparam_viewfrustum = 1019,
    sim_visionfloatparam_far_clipping = 1001,
    sim_visionfloatparam_near_clipping = 1000,
    sim_visionfloatparam_ortho_size = 1005,
    sim_visionfloatparam_perspective_angle = 1004,
    sim_visionfloatparam_pov_aperture = 1015,
    sim_visionfloatparam_pov_blur_distance = 1014,
    sim_visionintparam_depthignored = 1021,
    sim_visionintparam_disabled_light_components = 1006,
    sim_visionintparam_entity_to_render = 1008,
    sim_visionintparam_perspective_operation = 1018,
    sim_visionintparam_pov_blur_sampled = 1016,
    sim_visionintparam_pov_focal_blur = 1013,
    sim_visionintparam_render_mode = 1017,
    sim_visionintparam_rendering_attributes = 1007,
    sim_visionintparam_resolution_x = 1002,
    sim_visionintparam_resolution_y = 1003,
    sim_visionintparam_rgbignored = 1020,
    sim_visionintparam_windowed_pos_x = 1011,
    sim_visionintparam_windowed_pos_y = 1012,
    sim_visionintparam_windowed_size_x = 1009,
    sim_visionintparam_windowed_size_y = 1010,
    sim_volume_cone = 3,
    sim_volume_cylinder = 1,
    sim_volume_disc = 2,
    sim_volume_pyramid = 0,
    sim_volume_randomizedray = 5,
    sim_volume_ray = 4,
    sim_vortex_body_adhesiveforce = 24015,
    sim_vortex_body_angularvelocitydamping = 24017,
    sim_vortex_body_autoangulardamping = 26009,
    sim_vortex_body_autoangulardampingtensionratio = 24033,
    sim_vortex_body_autosleepangularaccelthreshold = 24031,
    sim_vortex_body_autosleepangularspeedthreshold = 24030,
    sim_vortex_body_autosleeplinearaccelthreshold = 24029,
    sim_vortex_body_autosleeplinearspeedthreshold = 24028,
    sim_vortex_body_autosleepsteplivethreshold = 25007,
    sim_vortex_body_autoslip = 26005,
    sim_vortex_body_bitcoded = 25006,
    sim_vortex_body_compliance = 24011,
    sim_vortex_body_convexshapesasrandom = 26002,
    sim_vortex_body_damping = 24012,
    sim_vortex_body_fastmoving = 26004,
    sim_vortex_body_linearvelocitydamping = 24016,
    sim_vortex_body_materialuniqueid = 25008,
    sim_vortex_body_normalangularaxisfriction = 24005,
    sim_vortex_body_normalangularaxisfrictionmodel = 25005,
    sim_vortex_body_normalangularaxisslide = 24022,
    sim_vortex_body_normalangularaxisslip = 24027,
    sim_vortex_body_normalangularaxisstaticfrictionscale = 24010,
    sim_vortex_body_normalmangulararaxisfrictionmodel = 25005,
    sim_vortex_body_normangaxissameasprimangaxis = 26008,
    sim_vortex_body_primangulararaxisfrictionmodel = 25003,
    sim_vortex_body_primangularaxisfriction = 24003,
    sim_vortex_body_primangularaxisslide = 24020,
    sim_vortex_body_primangularaxisslip = 24025,
    sim_vortex_body_primangularaxisstaticfrictionscale = 24008,
    sim_vortex_body_primaxisvectorx = 24034,
    sim_vortex_body_primaxisvectory = 24035,
    sim_vortex_body_primaxisvectorz = 24036,
    sim_vortex_body_primlinearaxisfriction = 24001,
    sim_vortex_body_primlinearaxisfrictionmodel = 25001,
    sim_vortex_body_primlinearaxisslide = 24018,
    sim_vortex_body_primlinearaxisslip = 24023,
    sim_vortex_body_primlinearaxisstaticfrictionscale = 24006,
    sim_vortex_body_pureshapesasconvex = 26001,
    sim_vortex_body_randomshapesasterrain = 26003,
    sim_vortex_body_restitution = 24013,
    sim_vortex_body_restitutionthreshold = 24014,
    sim_vortex_body_secangaxissameasprimangaxis = 26007,
    sim_vortex_body_secangularaxisfriction = 24004,
    sim_vortex_body_secangularaxisfrictionmodel = 25004,
    sim_vortex_body_secangularaxisslide = 24021,
    sim_vortex_body_secangularaxisslip = 24026,
    sim_vortex_body_secangularaxisstaticfrictionscale = 24009,
    sim_vortex_body_seclinaxissameasprimlinaxis = 26006,
    sim_vortex_body_seclinearaxisfriction = 24002,
    sim_vortex_body_seclinearaxisfrictionmodel = 25002,
    sim_vortex_body_seclinearaxisslide = 24019,
    sim_vortex_body_seclinearaxisslip = 24024,
    sim_vortex_body_seclinearaxisstaticfrictionscale = 24007,
    sim_vortex_body_secmangulararaxisfrictionmodel = 25004,
    sim_vortex_body_skinthickness = 24032,
    sim_vortex_bodyfrictionmodel_box = 0,
    sim_vortex_bodyfrictionmodel_neutral = 5,
    sim_vortex_bodyfrictionmodel_none = 6,
    sim_vortex_bodyfrictionmodel_prophigh = 3,
    sim_vortex_bodyfrictionmodel_proplow = 2,
    sim_vortex_bodyfrictionmodel_scaledbox = 1,
    sim_vortex_bodyfrictionmodel_scaledboxfast = 4,
    sim_vortex_global_autosleep = 20001,
    sim_vortex_global_bitcoded = 19001,
    sim_vortex_global_computeinertias = 20005,
    sim_vortex_global_constraintangularcompliance = 18007,
    sim_vortex_global_constraintangulardamping = 18008,
    sim_vortex_global_constraintangularkineticloss = 18009,
    sim_vortex_global_constraintlinearcompliance = 18004,
    sim_vortex_global_constraintlineardamping = 18005,
    sim_vortex_global_constraintlinearkineticloss = 18006,
    sim_vortex_global_contacttolerance = 18003,
    sim_vortex_global_internalscalingfactor = 18002,
    sim_vortex_global_multithreading = 20002,
    sim_vortex_global_stepsize = 18001,
    sim_vortex_joint_a0damping = 21032,
    sim_vortex_joint_a0frictioncoeff = 21033,
    sim_vortex_joint_a0frictionloss = 21035,
    sim_vortex_joint_a0frictionmaxforce = 21034,
    sim_vortex_joint_a0loss = 21030,
    sim_vortex_joint_a0stiffness = 21031,
    sim_vortex_joint_a1damping = 21038,
    sim_vortex_joint_a1frictioncoeff = 21039,
    sim_vortex_joint_a1frictionloss = 21041,
    sim_vortex_joint_a1frictionmaxforce = 21040,
    sim_vortex_joint_a1loss = 21036,
    sim_vortex_joint_a1stiffness = 21037,
    sim_vortex_joint_a2damping = 21044,
    sim_vortex_joint_a2frictioncoeff = 21045,
    sim_vortex_joint_a2frictionloss = 21047,
    sim_vortex_joint_a2frictionmaxforce = 21046,
    sim_vortex_joint_a2loss = 21042,
    sim_vortex_joint_a2stiffness = 21043,
    sim_vortex_joint_bitcoded = 22001,
    sim_vortex_joint_dependencyfactor = 21048,
    sim_vortex_joint_dependencyoffset = 21049,
    sim_vortex_joint_dependentobjectid = 22006,
    sim_vortex_joint_frictionenabledbc = 22003,
    sim_vortex_joint_frictionproportionalbc = 22004,
    sim_vortex_joint_lowerlimitdamping = 21001,
    sim_vortex_joint_lowerlimitmaxforce = 21007,
    sim_vortex_joint_lowerlimitrestitution = 21005,
    sim_vortex_joint_lowerlimitstiffness = 21003,
    sim_vortex_joint_motorconstraintfrictioncoeff = 21009,
    sim_vortex_joint_motorconstraintfrictionloss = 21011,
    sim_vortex_joint_motorconstraintfrictionmaxforce = 21010,
    sim_vortex_joint_motorfrictionenabled = 23001,
    sim_vortex_joint_objectid = 22005,
    sim_vortex_joint_p0damping = 21014,
    sim_vortex_joint_p0frictioncoeff = 21015,
    sim_vortex_joint_p0frictionloss = 21017,
    sim_vortex_joint_p0frictionmaxforce = 21016,
    sim_vortex_joint_p0loss = 21012,
    sim_vortex_joint_p0stiffness = 21013,
    sim_vortex_joint_p1damping = 21020,
    sim_vortex_joint_p1frictioncoeff = 21021,
    sim_vortex_joint_p1frictionloss = 21023,
    sim_vortex_joint_p1frictionmaxforce = 21022,
    sim_vortex_joint_p1loss = 21018,
    sim_vortex_joint_p1stiffness = 21019,
    sim_vortex_joint_p2damping = 21026,
    sim_vortex_joint_p2frictioncoeff = 21027,
    sim_vortex_joint_p2frictionloss = 21029,
    sim_vortex_joint_p2frictionmaxforce = 21028,
    sim_vortex_joint_p2loss = 21024,
    sim_vortex_joint_p2stiffness = 21025,
    sim_vortex_joint_pospid1 = 21052,
    sim_vortex_joint_pospid2 = 21053,
    sim_vortex_joint_pospid3 = 21054,
    sim_vortex_joint_proportionalmotorfriction = 23002,
    sim_vortex_joint_relaxationenabledbc = 22002,
    sim_vortex_joint_upperlimitdamping = 21002,
    sim_vortex_joint_upperlimitmaxforce = 21008,
    sim_vortex_joint_upperlimitrestitution = 21006,
    sim_vortex_joint_upperlimitstiffness = 21004,
};

/* X(result, name, symbol, parameters) for every function. A parameter n... is the number of values of the one before it. */
#define SWANILDA_FUNCTIONS(X) \
    X(int, simAddLog, "simAddLog", (const char* a, int b, const char* c)) \
    X(int, simSetLastError, "simSetLastError", (const char* a, const char* b)) \
    X(char*, simGetLastError, "simGetLastError", (void)) \
    X(void*, simCreateBuffer, "simCreateBuffer", (int a)) \
    X(int, simReleaseBuffer, "simReleaseBuffer", (const void* a)) \
    X(int, simRegisterScriptCallbackFunction, "simRegisterScriptCallbackFunction", (const char* a, const char* b, void (*c)(struct SScriptCallBack*))) \
    X(int, simRegisterScriptVariable, "simRegisterScriptVariable", (const char* a, const char* b, int c)) \
    X(int, simSetPluginInfo, "simSetPluginInfo", (const char* a, int b, const char* c, int d)) \
    X(int, simGetPluginInfo, "simGetPluginInfo", (const char* a, int b, char** c, int* d)) \
    X(int, simCallMethod, "simCallMethod", (long long int a, const char* b, int c, int d, int e)) \
    X(int, simCallScriptFunctionEx, "simCallScriptFunctionEx", (int a, const char* b, int c)) \
    X(int, simExecuteScriptString, "simExecuteScriptString", (int a, const char* b, int c)) \
    X(int, simCreateStack, "simCreateStack", (void)) \
    X(int, simReleaseStack, "simReleaseStack", (int a)) \
    X(int, simCopyStack, "simCopyStack", (int a)) \
    X(int, simPushNullOntoStack, "simPushNullOntoStack", (int a)) \
    X(int, simPushBoolOntoStack, "simPushBoolOntoStack", (int a, bool b)) \
    X(int, simPushInt32OntoStack, "simPushInt32OntoStack", (int a, int b)) \
    X(int, simPushInt64OntoStack, "simPushInt64OntoStack", (int a, long long int b)) \
    X(int, simPushFloatOntoStack, "simPushFloatOntoStack", (int a, float b)) \
    X(int, simPushDoubleOntoStack, "simPushDoubleOntoStack", (int a, double b)) \
    X(int, simPushTextOntoStack, "simPushTextOntoStack", (int a, const char* b)) \
    X(int, simPushStringOntoStack, "simPushStringOntoStack", (int a, const char* b, int nb)) \
    X(int, simPushBufferOntoStack, "simPushBufferOntoStack", (int a, const char* b, int nb)) \
    X(int, simPushUInt8TableOntoStack, "simPushUInt8TableOntoStack", (int a, const unsigned char* b, int nb)) \
    X(int, simPushInt32TableOntoStack, "simPushInt32TableOntoStack", (int a, const int* b, int nb)) \
    X(int, simPushInt64TableOntoStack, "simPushInt64TableOntoStack", (int a, const long long int* b, int nb)) \
    X(int, simPushFloatTableOntoStack, "simPushFloatTableOntoStack", (int a, const float* b, int nb)) \
    X(int, simPushDoubleTableOntoStack, "simPushDoubleTableOntoStack", (int a, const double* b, int nb)) \
    X(int, simPushTableOntoStack, "simPushTableOntoStack", (int a)) \
    X(int, simInsertDataIntoStackTable, "simInsertDataIntoStackTable", (int a)) \
    X(int, simGetStackSize, "simGetStackSize", (int a)) \
    X(int, simPopStackItem, "simPopStackItem", (int a, int b)) \
    X(int, simMoveStackItemToTop, "simMoveStackItemToTop", (int a, int b)) \
    X(int, simGetStackItemType, "simGetStackItemType", (int a, int b)) \
    X(int, simIsStackValueNull, "simIsStackValueNull", (int a)) \
    X(int, simGetStackBoolValue, "simGetStackBoolValue", (int a, bool* b)) \
    X(int, simGetStackInt32Value, "simGetStackInt32Value", (int a, int* b)) \
    X(int, simGetStackInt64Value, "simGetStackInt64Value", (int a, long long int* b)) \
    X(int, simGetStackFloatValue, "simGetStackFloatValue", (int a, float* b)) \
    X(int, simGetStackDoubleValue, "simGetStackDoubleValue", (int a, double* b)) \
    X(char*, simGetStackStringValue, "simGetStackStringValue", (int a, int* b)) \
    X(int, simGetStackTableInfo, "simGetStackTableInfo", (int a, int b)) \
    X(int, simGetStackUInt8Table, "simGetStackUInt8Table", (int a, unsigned char* b, int nb)) \
    X(int, simGetStackInt32Table, "simGetStackInt32Table", (int a, int* b, int nb)) \
    X(int, simGetStackInt64Table, "simGetStackInt64Table", (int a, long long int* b, int nb)) \
    X(int, simGetStackFloatTable, "simGetStackFloatTable", (int a, float* b, int nb)) \
    X(int, simGetStackDoubleTable, "simGetStackDoubleTable", (int a, double* b, int nb)) \
    X(int, simUnfoldStackTable, "simUnfoldStackTable", (int a)) \
    X(int, simDebugStack, "simDebugStack", (int a, int b)) \
    X(char*, simPackTable, "simPackTable", (int a, int* b)) \
    X(int, simUnpackTable, "simUnpackTable", (const char* a, int na)) \
    X(int, simGetObject, "simGetObject", (const char* a, int b, int c, int d)) \
    X(int, simReadProximitySensor, "simReadProximitySensor_D", (int a, double* b, int* c, double* d)) \
    X(int, simHandleProximitySensor, "simHandleProximitySensor_D", (int a, double* b, int* c, double* d)) \
    X(int, simReadForceSensor, "simReadForceSensor_D", (int a, double* b, double* c)) \
    X(int, simCheckCollision, "simCheckCollision", (int a, int b)) \
    X(int, simCheckDistance, "simCheckDistance_D", (int a, int b, double c, double* d)) \
    X(int, simGetObjectPosition, "simGetObjectPosition_D", (int a, int b, double* c)) \
    X(int, simGetObjectOrientation, "simGetObjectOrientation_D", (int a, int b, double* c)) \
    X(int, simGetObjectQuaternion, "simGetObjectQuaternion_D", (int a, int b, double* c)) \
    X(int, simGetObjectPose, "simGetObjectPose_D", (int a, int b, double* c)) \
    X(int, simGetObjectMatrix, "simGetObjectMatrix_D", (int a, int b, double* c)) \
    X(int, simSetObjectPosition, "simSetObjectPosition_D", (int a, int b, const double* c)) \
    X(int, simSetObjectOrientation, "simSetObjectOrientation_D", (int a, int b, const double* c)) \
    X(int, simSetObjectQuaternion, "simSetObjectQuaternion_D", (int a, int b, const double* c)) \
    X(int, simSetObjectPose, "simSetObjectPose_D", (int a, int b, const double* c)) \
    X(int, simSetObjectMatrix, "simSetObjectMatrix_D", (int a, int b, const double* c)) \
    X(int, simGetObjectChildPose, "simGetObjectChildPose_D", (int a, double* b)) \
    X(int, simSetObjectChildPose, "simSetObjectChildPose_D", (int a, const double* b)) \
    X(int, simGetObjectVelocity, "simGetObjectVelocity_D", (int a, double* b, double* c)) \
    X(int, simGetVelocity, "simGetVelocity_D", (int a, double* b, double* c)) \
    X(char*, simGetObjectAlias, "simGetObjectAlias", (int a, int b)) \
    X(int, simSetObjectAlias, "simSetObjectAlias", (int a, const char* b, int c)) \
    X(int, simGetObjectParent, "simGetObjectParent", (int a)) \
    X(int, simSetObjectParent, "simSetObjectParent", (int a, int b, bool c)) \
    X(int, simGetObjectChild, "simGetObjectChild", (int a, int b)) \
    X(int, simGetObjectType, "simGetObjectType", (int a)) \
    X(long long int, simGetObjectUid, "simGetObjectUid", (int a)) \
    X(int, simGetObjectFromUid, "simGetObjectFromUid", (long long int a, int b)) \
    X(int, simGetObjects, "simGetObjects", (int a, int b)) \
    X(int*, simGetObjectsInTree, "simGetObjectsInTree", (int a, int b, int c, int* d)) \
    X(int*, simGetObjectSel, "simGetObjectSel", (int* a)) \
    X(int, simSetObjectSel, "simSetObjectSel", (const int* a, int na)) \
    X(int, simRemoveObjects, "simRemoveObjects", (const int* a, int na)) \
    X(int, simRemoveModel, "simRemoveModel", (int a)) \
    X(int, simCopyPasteObjects, "simCopyPasteObjects", (int* a, int na, int b)) \
    X(int, simScaleObjects, "simScaleObjects_D", (const int* a, int na, double b, bool c)) \
    X(int, simGetObjectInt32Param, "simGetObjectInt32Param", (int a, int b, int* c)) \
    X(int, simSetObjectInt32Param, "simSetObjectInt32Param", (int a, int b, int c)) \
    X(int, simGetObjectFloatParam, "simGetObjectFloatParam_D", (int a, int b, double* c)) \
    X(int, simSetObjectFloatParam, "simSetObjectFloatParam_D", (int a, int b, double c)) \
    X(char*, simGetObjectStringParam, "simGetObjectStringParam", (int a, int b, int* c)) \
    X(int, simSetObjectStringParam, "simSetObjectStringParam", (int a, int b, const char* c, int nc)) \
    X(int, simGetObjectProperty, "simGetObjectProperty", (int a)) \
    X(int, simSetObjectProperty, "simSetObjectProperty", (int a, int b)) \
    X(int, simGetObjectSpecialProperty, "simGetObjectSpecialProperty", (int a)) \
    X(int, simSetObjectSpecialProperty, "simSetObjectSpecialProperty", (int a, int b)) \
    X(int, simGetModelProperty, "simGetModelProperty", (int a)) \
    X(int, simSetModelProperty, "simSetModelProperty", (int a, int b)) \
    X(int, simGetExplicitHandling, "simGetExplicitHandling", (int a)) \
    X(int, simSetExplicitHandling, "simSetExplicitHandling", (int a, int b)) \
    X(int, simGetObjectHierarchyOrder, "simGetObjectHierarchyOrder", (int a, int* b)) \
    X(int, simSetObjectHierarchyOrder, "simSetObjectHierarchyOrder", (int a, int b)) \
    X(double, simGetObjectSizeFactor, "simGetObjectSizeFactor_D", (int a)) \
    X(int, simGetObjectColor, "simGetObjectColor", (int a, int b, int c, float* d)) \
    X(int, simSetObjectColor, "simSetObjectColor", (int a, int b, int c, const float* d)) \
    X(int, simIsHandle, "simIsHandle", (int a, int b)) \
    X(int, simIsDynamicallyEnabled, "simIsDynamicallyEnabled", (int a)) \
    X(int, simResetDynamicObject, "simResetDynamicObject", (int a)) \
    X(char*, simGetExtensionString, "simGetExtensionString", (int a, int b, const char* c)) \
    X(int, simGetLinkDummy, "simGetLinkDummy", (int a)) \
    X(int, simSetLinkDummy, "simSetLinkDummy", (int a, int b)) \
    X(int, simGetJointPosition, "simGetJointPosition_D", (int a, double* b)) \
    X(int, simSetJointPosition, "simSetJointPosition_D", (int a, double b)) \
    X(int, simGetJointTargetPosition, "simGetJointTargetPosition_D", (int a, double* b)) \
    X(int, simSetJointTargetPosition, "simSetJointTargetPosition_D", (int a, double b)) \
    X(int, simGetJointTargetVelocity, "simGetJointTargetVelocity_D", (int a, double* b)) \
    X(int, simSetJointTargetVelocity, "simSetJointTargetVelocity_D", (int a, double b)) \
    X(int, simGetJointTargetForce, "simGetJointTargetForce_D", (int a, double* b)) \
    X(int, simSetJointTargetForce, "simSetJointTargetForce_D", (int a, double b, bool c)) \
    X(int, simGetJointForce, "simGetJointForce_D", (int a, double* b)) \
    X(int, simGetJointVelocity, "simGetJointVelocity_D", (int a, double* b)) \
    X(int, simGetJointInterval, "simGetJointInterval_D", (int a, bool* b, double* c)) \
    X(int, simSetJointInterval, "simSetJointInterval_D", (int a, bool b, const double* c)) \
    X(int, simGetJointMatrix, "simGetJointMatrix_D", (int a, double* b)) \
    X(int, simSetSphericalJointMatrix, "simSetSphericalJointMatrix_D", (int a, const double* b)) \
    X(int, simGetJointMode, "simGetJointMode", (int a, int* b)) \
    X(int, simSetJointMode, "simSetJointMode", (int a, int b, int c)) \
    X(int, simGetJointType, "simGetJointType", (int a)) \
    X(int, simGetJointDependency, "simGetJointDependency_D", (int a, int* b, double* c, double* d)) \
    X(int, simSetJointDependency, "simSetJointDependency_D", (int a, int b, double c, double d)) \
    X(int, simCreateDummy, "simCreateDummy_D", (double a, const void* b)) \
    X(int, simCreateJoint, "simCreateJoint_D", (int a, int b, int c, const double* d, const void* e, const void* f)) \
    X(int, simCreatePrimitiveShape, "simCreatePrimitiveShape_D", (int a, const double* b, int c)) \
    X(int, simCreateMeshShape, "simCreateMeshShape_D", (int a, double b, const double* c, int nc, const int* d, int nd, const void* e)) \
    X(int, simCreateForceSensor, "simCreateForceSensor_D", (int a, const int* b, const double* c, const void* d)) \
    X(int, simCreateProximitySensor, "simCreateProximitySensor_D", (int a, int b, int c, const int* d, const double* e, const void* f)) \
    X(int, simCreateVisionSensor, "simCreateVisionSensor_D", (int a, const int* b, const double* c, const void* d)) \
    X(int, simGetShapeMass, "simGetShapeMass_D", (int a, double* b)) \
    X(int, simSetShapeMass, "simSetShapeMass_D", (int a, double b)) \
    X(int, simGetShapeInertia, "simGetShapeInertia_D", (int a, double* b, double* c)) \
    X(int, simSetShapeInertia, "simSetShapeInertia_D", (int a, const double* b, const double* c)) \
    X(int, simComputeMassAndInertia, "simComputeMassAndInertia_D", (int a, double b)) \
    X(int, simSetShapeColor, "simSetShapeColor", (int a, const char* b, int c, const float* d)) \
    X(int, simGroupShapes, "simGroupShapes", (const int* a, int na)) \
    X(int*, simUngroupShape, "simUngroupShape", (int a, int* b)) \
    X(int, simAddForce, "simAddForce_D", (int a, const double* b, const double* c)) \
    X(int, simAddForceAndTorque, "simAddForceAndTorque_D", (int a, const double* b, const double* c)) \
    X(int, simResetProximitySensor, "simResetProximitySensor", (int a)) \
    X(int, simResetVisionSensor, "simResetVisionSensor", (int a)) \
    X(int, simResetGraph, "simResetGraph", (int a)) \
    X(int, simSetGraphStreamValue, "simSetGraphStreamValue_D", (int a, int b, double c)) \
    X(int, simGetVisionSensorRes, "simGetVisionSensorRes", (int a, int* b)) \
    X(char*, simGetVisionSensorImg, "simGetVisionSensorImg_D", (int a, int b, double c, const int* d, const int* e, int* f)) \
    X(int, simCreateCollectionEx, "simCreateCollectionEx", (int a)) \
    X(int, simAddItemToCollection, "simAddItemToCollection", (int a, int b, int c, int d)) \
    X(int, simDestroyCollection, "simDestroyCollection", (int a)) \
    X(int*, simGetCollectionObjects, "simGetCollectionObjects", (int a, int* b)) \
    X(int, simBuildIdentityMatrix, "simBuildIdentityMatrix_D", (double* a)) \
    X(int, simBuildMatrix, "simBuildMatrix_D", (const double* a, const double* b, double* c)) \
    X(int, simBuildPose, "simBuildPose_D", (const double* a, const double* b, double* c)) \
    X(int, simInvertMatrix, "simInvertMatrix_D", (double* a)) \
    X(int, simInvertPose, "simInvertPose_D", (double* a)) \
    X(int, simMultiplyMatrices, "simMultiplyMatrices_D", (const double* a, const double* b, double* c)) \
    X(int, simMultiplyPoses, "simMultiplyPoses_D", (const double* a, const double* b, double* c)) \
    X(int, simInterpolateMatrices, "simInterpolateMatrices_D", (const double* a, const double* b, double c, double* d)) \
    X(int, simInterpolatePoses, "simInterpolatePoses_D", (const double* a, const double* b, double c, double* d)) \
    X(int, simMatrixToPose, "simMatrixToPose_D", (const double* a, double* b)) \
    X(int, simPoseToMatrix, "simPoseToMatrix_D", (const double* a, double* b)) \
    X(int, simTransformVector, "simTransformVector_D", (const double* a, double* b)) \
    X(int, simGetEulerAnglesFromMatrix, "simGetEulerAnglesFromMatrix_D", (const double* a, double* b)) \
    X(int, simGetRotationAxis, "simGetRotationAxis_D", (const double* a, const double* b, double* c, double* d)) \
    X(int, simRotateAroundAxis, "simRotateAroundAxis_D", (const double* a, const double* b, const double* c, double d, double* e)) \
    X(double, simGetSimulationTime, "simGetSimulationTime_D", (void)) \
    X(int, simGetSimulationState, "simGetSimulationState", (void)) \
    X(double, simGetSimulationTimeStep, "simGetSimulationTimeStep_D", (void)) \
    X(int, simSetSimulationTimeStep, "simSetSimulationTimeStep_D", (double a)) \
    X(int, simGetRealTimeSimulation, "simGetRealTimeSimulation", (void)) \
    X(double, simGetSystemTime, "simGetSystemTime_D", (void)) \
    X(int, simStartSimulation, "simStartSimulation", (void)) \
    X(int, simPauseSimulation, "simPauseSimulation", (void)) \
    X(int, simStopSimulation, "simStopSimulation", (void)) \
    X(int, simAnnounceSceneContentChange, "simAnnounceSceneContentChange", (void)) \
    X(int, simLoadScene, "simLoadScene", (const char* a)) \
    X(int, simLoadModel, "simLoadModel", (const char* a)) \
    X(int, simSaveScene, "simSaveScene", (const char* a)) \
    X(int, simSaveModel, "simSaveModel", (int a, const char* b)) \
    X(int, simCloseScene, "simCloseScene", (void)) \
    X(int, simGetBoolParam, "simGetBoolParam", (int a)) \
    X(int, simSetBoolParam, "simSetBoolParam", (int a, bool b)) \
    X(int, simGetInt32Param, "simGetInt32Param", (int a, int* b)) \
    X(int, simSetInt32Param, "simSetInt32Param", (int a, int b)) \
    X(int, simGetFloatParam, "simGetFloatParam_D", (int a, double* b)) \
    X(int, simSetFloatParam, "simSetFloatParam_D", (int a, double b)) \
    X(char*, simGetStringParam, "simGetStringParam", (int a)) \
    X(int, simSetStringParam, "simSetStringParam", (int a, const char* b)) \
    X(int, simGetArrayParam, "simGetArrayParam_D", (int a, double* b)) \
    X(int, simSetArrayParam, "simSetArrayParam_D", (int a, const double* b)) \
    X(char*, simGetNamedStringParam, "simGetNamedStringParam", (const char* a, int* b)) \
    X(int, simSetNamedStringParam, "simSetNamedStringParam", (const char* a, const char* b, int nb)) \
    X(int, simSetInt32Signal, "simSetInt32Signal", (const char* a, int b)) \
    X(int, simGetInt32Signal, "simGetInt32Signal", (const char* a, int* b)) \
    X(int, simClearInt32Signal, "simClearInt32Signal", (const char* a)) \
    X(int, simSetFloatSignal, "simSetFloatSignal_D", (const char* a, double b)) \
    X(int, simGetFloatSignal, "simGetFloatSignal_D", (const char* a, double* b)) \
    X(int, simClearFloatSignal, "simClearFloatSignal", (const char* a)) \
    X(int, simSetStringSignal, "simSetStringSignal", (const char* a, const char* b, int nb)) \
    X(char*, simGetStringSignal, "simGetStringSignal", (const char* a, int* b)) \
    X(int, simClearStringSignal, "simClearStringSignal", (const char* a)) \
    X(char*, simReadCustomDataBlock, "simReadCustomDataBlock", (int a, const char* b, int* c)) \
    X(int, simWriteCustomDataBlock, "simWriteCustomDataBlock", (int a, const char* b, const char* c, int nc)) \
    X(char*, simPersistentDataRead, "simPersistentDataRead", (const char* a, int* b)) \
    X(int, simPersistentDataWrite, "simPersistentDataWrite", (const char* a, const char* b, int nb, int c)) \
    X(int, simAuxiliaryConsoleOpen, "simAuxiliaryConsoleOpen", (const char* a, int b, int c, const int* d, const int* e, const float* f, const float* g)) \
    X(int, simAuxiliaryConsolePrint, "simAuxiliaryConsolePrint", (int a, const char* b)) \
    X(int, simAuxiliaryConsoleShow, "simAuxiliaryConsoleShow", (int a, bool b)) \
    X(int, simAuxiliaryConsoleClose, "simAuxiliaryConsoleClose", (int a)) \
    X(int, simGetBoolProperty, "simGetBoolProperty", (long long int a, const char* b, int* c)) \
    X(int, simSetBoolProperty, "simSetBoolProperty", (long long int a, const char* b, int c)) \
    X(int, simGetIntProperty, "simGetIntProperty", (long long int a, const char* b, int* c)) \
    X(int, simSetIntProperty, "simSetIntProperty", (long long int a, const char* b, int c)) \
    X(int, simGetLongProperty, "simGetLongProperty", (long long int a, const char* b, long long int* c)) \
    X(int, simSetLongProperty, "simSetLongProperty", (long long int a, const char* b, long long int c)) \
    X(int, simGetFloatProperty, "simGetFloatProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetFloatProperty, "simSetFloatProperty", (long long int a, const char* b, double c)) \
    X(char*, simGetStringProperty, "simGetStringProperty", (long long int a, const char* b)) \
    X(int, simGetStringProperty2, "simGetStringProperty2", (long long int a, const char* b, char** c)) \
    X(int, simSetStringProperty, "simSetStringProperty", (long long int a, const char* b, const char* c)) \
    X(char*, simGetBufferProperty, "simGetBufferProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetBufferProperty2, "simGetBufferProperty2", (long long int a, const char* b, char** c, int* d)) \
    X(int, simSetBufferProperty, "simSetBufferProperty", (long long int a, const char* b, const char* c, int nc)) \
    X(int, simGetIntArray2Property, "simGetIntArray2Property", (long long int a, const char* b, int* c)) \
    X(int, simSetIntArray2Property, "simSetIntArray2Property", (long long int a, const char* b, const int* c)) \
    X(int, simGetVector2Property, "simGetVector2Property", (long long int a, const char* b, double* c)) \
    X(int, simSetVector2Property, "simSetVector2Property", (long long int a, const char* b, const double* c)) \
    X(int, simGetVector3Property, "simGetVector3Property", (long long int a, const char* b, double* c)) \
    X(int, simSetVector3Property, "simSetVector3Property", (long long int a, const char* b, const double* c)) \
    X(int, simGetQuaternionProperty, "simGetQuaternionProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetQuaternionProperty, "simSetQuaternionProperty", (long long int a, const char* b, const double* c)) \
    X(int, simGetPoseProperty, "simGetPoseProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetPoseProperty, "simSetPoseProperty", (long long int a, const char* b, const double* c)) \
    X(int, simGetColorProperty, "simGetColorProperty", (long long int a, const char* b, float* c)) \
    X(int, simSetColorProperty, "simSetColorProperty", (long long int a, const char* b, const float* c)) \
    X(double*, simGetFloatArrayProperty, "simGetFloatArrayProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetFloatArrayProperty2, "simGetFloatArrayProperty2", (long long int a, const char* b, double** c, int* d)) \
    X(int, simSetFloatArrayProperty, "simSetFloatArrayProperty", (long long int a, const char* b, const double* c, int nc)) \
    X(int*, simGetIntArrayProperty, "simGetIntArrayProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetIntArrayProperty2, "simGetIntArrayProperty2", (long long int a, const char* b, int** c, int* d)) \
    X(int, simSetIntArrayProperty, "simSetIntArrayProperty", (long long int a, const char* b, const int* c, int nc)) \
    X(int, simRemoveProperty, "simRemoveProperty", (long long int a, const char* b)) \
    X(int, simGetScriptHandleEx, "simGetScriptHandleEx", (int a, int b, const char* c)) \
    X(int, simInitScript, "simInitScript", (int a)) \
    X(int, simCreateScript, "simCreateScript", (int a, const char* b, int c, const char* d)) \
    X(int, simAddScript, "simAddScript", (int a)) \
    X(int, simRemoveScript, "simRemoveScript", (int a)) \
    X(int, simAssociateScriptWithObject, "simAssociateScriptWithObject", (int a, int b)) \
    X(int, simGetScriptInt32Param, "simGetScriptInt32Param", (int a, int b, int* c)) \
    X(int, simSetScriptInt32Param, "simSetScriptInt32Param", (int a, int b, int c)) \
    X(char*, simGetScriptStringParam, "simGetScriptStringParam", (int a, int b, int* c)) \
    X(int, simSetScriptStringParam, "simSetScriptStringParam", (int a, int b, const char* c, int nc)) \
    X(int, simCheckProximitySensor, "simCheckProximitySensor_D", (int a, int b, double* c)) \
    X(int, simCheckProximitySensorEx, "simCheckProximitySensorEx_D", (int a, int b, int c, double d, double e, double* f, int* g, double* h)) \
    X(int, simReadVisionSensor, "simReadVisionSensor_D", (int a, double** b, int** c)) \
    X(int, simHandleVisionSensor, "simHandleVisionSensor_D", (int a, double** b, int** c)) \
    X(int, simCheckVisionSensor, "simCheckVisionSensor_D", (int a, int b, double** c, int** d)) \
    X(char*, simGetVisionSensorDepth, "simGetVisionSensorDepth", (int a, int b, const int* c, const int* d, int* e)) \
    X(int, simGetContactInfo, "simGetContactInfo_D", (int a, int b, int c, int* d, double* e)) \
    X(int, simHandleDynamics, "simHandleDynamics_D", (double a)) \
    X(int, simGetEngineBoolParam, "simGetEngineBoolParam", (int a, int b, const void* c, bool* d)) \
    X(int, simGetEngineInt32Param, "simGetEngineInt32Param", (int a, int b, const void* c, bool* d)) \
    X(double, simGetEngineFloatParam, "simGetEngineFloatParam_D", (int a, int b, const void* c, bool* d)) \
    X(int, simSetEngineBoolParam, "simSetEngineBoolParam", (int a, int b, const void* c, bool d)) \
    X(int, simSetEngineInt32Param, "simSetEngineInt32Param", (int a, int b, const void* c, int d)) \
    X(int, simSetEngineFloatParam, "simSetEngineFloatParam_D", (int a, int b, const void* c, double d)) \
    X(int, simGetShapeMesh, "simGetShapeMesh_D", (int a, double** b, int* c, int** d, int* e, double** f)) \
    X(int, simGetShapeColor, "simGetShapeColor", (int a, const char* b, int c, float* d)) \
    X(int, simGetShapeGeomInfo, "simGetShapeGeomInfo_D", (int a, int* b, double* c, const void* d)) \
    X(int, simGetShapeTextureId, "simGetShapeTextureId", (int a)) \
    X(int, simSetShapeTexture, "simSetShapeTexture_D", (int a, int b, int c, int d, const double* e, const double* f, const double* g)) \
    X(int, simSetShapeMaterial, "simSetShapeMaterial", (int a, int b)) \
    X(int, simGetTextureId, "simGetTextureId", (const char* a, int* b)) \
    X(int, simAlignShapeBB, "simAlignShapeBB", (int a, const double* b)) \
    X(int, simRelocateShapeFrame, "simRelocateShapeFrame", (int a, const double* b)) \
    X(int, simReorientShapeBoundingBox, "simReorientShapeBoundingBox", (int a, int b, int c)) \
    X(int, simScaleObject, "simScaleObject_D", (int a, double b, double c, double d, int e)) \
    X(int, simGenerateShapeFromPath, "simGenerateShapeFromPath_D", (const double* a, int na, const double* b, int nb, int c, const double* d, double e)) \
    X(int, simGetQHull, "simGetQHull_D", (const double* a, int na, double** b, int* c, int** d, int* e, int f, const void* g)) \
    X(int, simCreateOctree, "simCreateOctree_D", (double a, int b, double c, const void* d)) \
    X(int, simSubtractObjectFromOctree, "simSubtractObjectFromOctree", (int a, int b, int c, const void* d)) \
    X(int, simCreatePointCloud, "simCreatePointCloud_D", (double a, int b, int c, double d, const void* e)) \
    X(int, simGetPointCloudOptions, "simGetPointCloudOptions_D", (int a, double* b, int* c, int* d, double* e, const void* f)) \
    X(int, simSetPointCloudOptions, "simSetPointCloudOptions_D", (int a, double b, int c, int d, double e, const void* f)) \
    X(int, simSubtractObjectFromPointCloud, "simSubtractObjectFromPointCloud_D", (int a, int b, int c, double d, const void* e)) \
    X(int, simAddGraphStream, "simAddGraphStream_D", (int a, const char* b, const char* c, int d, const float* e, double f)) \
    X(int, simSetGraphStreamTransformation, "simSetGraphStreamTransformation_D", (int a, int b, int c, double d, double e)) \
    X(int, simDuplicateGraphCurveToStatic, "simDuplicateGraphCurveToStatic", (int a, int b, const char* c)) \
    X(int, simDestroyGraphCurve, "simDestroyGraphCurve", (int a, int b)) \
    X(int, simHandleGraph, "simHandleGraph_D", (int a, double b)) \
    X(char*, simGetPersistentDataTags, "simGetPersistentDataTags", (int* a)) \
    X(char*, simReadCustomDataBlockTags, "simReadCustomDataBlockTags", (int a, int* b)) \
    X(char*, simGetSignalName, "simGetSignalName", (int a, int b)) \
    X(char*, simGetPropertyName, "simGetPropertyName", (long long int a, int b, const void* c)) \
    X(char*, simLoadImage, "simLoadImage", (int* a, int b, const char* c, const void* d)) \
    X(int, simSerialOpen, "simSerialOpen", (const char* a, int b, const void* c, const void* d)) \
    X(int, simSerialClose, "simSerialClose", (int a)) \
    X(int, simSerialCheck, "simSerialCheck", (int a)) \
    X(int, simSerialRead, "simSerialRead", (int a, unsigned char* b, int nb)) \
    X(int, simSerialSend, "simSerialSend", (int a, const char* b, int nb)) \
    X(int, simQuitSimulator, "simQuitSimulator", (bool a)) \
    X(int, _simGetTimeDiffInMs, "_simGetTimeDiffInMs", (int a)) \
    X(int, simAddDrawingObjectItem, "simAddDrawingObjectItem_D", (int a, const void* b)) \
    X(int, simAddDrawingObject, "simAddDrawingObject_D", (int a, double b, double c, int d, int e, const float* f, const void* g, const float* h, const float* i)) \
    X(int, simAddGraphCurve, "simAddGraphCurve_D", (int a, const char* b, int c, const void* d, const void* e, const char* f, int g, const float* h, int i)) \
    X(int, simAddPointCloud, "simAddPointCloud_D", (int a, int b, int c, int d, double e, int f, const void* g, const void* h, const void* i, const void* j)) \
    X(int, simAdjustView, "simAdjustView", (int a, int b, int c, const char* d)) \
    X(int, simApplyTexture, "simApplyTexture_D", (int a, const void* b, int c, const void* d, const void* e, int f)) \
    X(int, simCameraFitToView, "simCameraFitToView_D", (int a, int b, const void* c, int d, double e)) \
    X(int, simCheckCollisionEx, "simCheckCollisionEx_D", (int a, int b, double** c)) \
    X(int, simCheckOctreePointOccupancy, "simCheckOctreePointOccupancy_D", (int a, int b, const void* c, int d, int* e, long long int* f, const void* g)) \
    X(int, simCheckProximitySensorEx2, "simCheckProximitySensorEx2_D", (int a, const void* b, int c, int d, int e, double f, double g, double* h, double* i)) \
    X(float*, simCheckVisionSensorEx, "simCheckVisionSensorEx", (int a, int b, bool c)) \
    X(int, simConvexDecompose, "simConvexDecompose_D", (int a, int b, const int* c, const double* d)) \
    X(int, simCreateHeightfieldShape, "simCreateHeightfieldShape_D", (int a, double b, int c, int d, double e, const void* f)) \
    X(int, simCreateShape, "simCreateShape", (int a, double b, const double* c, int nc, const int* d, int nd, const void* e, const void* f, const void* g, const int* h)) \
    X(int, simCreateTexture, "simCreateTexture_D", (const char* a, int b, const double* c, const double* d, const void* e, int f, int* g, int* h, const void* i)) \
    X(int, simDoesFileExist, "simDoesFileExist", (const char* a)) \
    X(int, simExportMesh, "simExportMesh_D", (int a, const char* b, int c, double d, int e, const void* f, const void* g, const void* h, const void* i, const void* j, const void* k)) \
    X(int, simExtCallScriptFunction, "simExtCallScriptFunction_D", (int a, const char* b, const void* c, int d, const void* e, int f, const void* g, int h, const void* i, int j, void* k, void* l, void* m, void* n, void* o, void* p, void* q, void* r)) \
    X(int, simFloatingViewAdd, "simFloatingViewAdd_D", (double a, double b, double c, double d, int e)) \
    X(int, simFloatingViewRemove, "simFloatingViewRemove", (int a)) \
    X(char*, simGetApiFunc, "simGetApiFunc", (int a, const char* b)) \
    X(char*, simGetApiInfo, "simGetApiInfo", (int a, const char* b)) \
    X(int, simGetDecimatedMesh, "simGetDecimatedMesh_D", (const void* a, int b, const void* c, int d, double** e, int* f, int** g, int* h, double i, int j, const void* k)) \
    X(int, simGetHandleArrayProperty2, "simGetHandleArrayProperty2", (long long int a, const char* b, long long int** c, int* d)) \
    X(int, simGetHandleProperty, "simGetHandleProperty", (long long int a, const char* b, long long int* c)) \
    X(int, simGetLightParameters, "simGetLightParameters_D", (int a, const void* b, double* c, double* d)) \
    X(int, simGetModuleInfo, "simGetModuleInfo", (const char* a, int b, char** c, int* d)) \
    X(char*, simGetModuleName, "simGetModuleName", (int a, unsigned char* b)) \
    X(int, simGetNavigationMode, "simGetNavigationMode", (void)) \
    X(double*, simGetObjectFloatArrayParam, "simGetObjectFloatArrayParam_D", (int a, int b, int* c)) \
    X(void*, simGetOctreeVoxels, "simGetOctreeVoxels_D", (int a, int* b, const void* c)) \
    X(int, simGetPage, "simGetPage", (void)) \
    X(char*, simGetPluginName, "simGetPluginName", (int a, unsigned char* b)) \
    X(void*, simGetPointCloudPoints, "simGetPointCloudPoints_D", (int a, int* b, const void* c)) \
    X(int, simGetReferencedHandles, "simGetReferencedHandles", (int a, int** b, const char* c, const void* d)) \
    X(void*, simGetScaledImage, "simGetScaledImage", (const void* a, const int* b, int* c, int d, const void* e)) \
    X(int, simGetSimulationPassesPerRenderingPass, "simGetSimulationPassesPerRenderingPass", (void)) \
    X(char*, simGetSimulatorMessage, "simGetSimulatorMessage", (int* a, int* b, int* c)) \
    X(int, simGetStackColor4, "simGetStackColor4", (int a, float* b)) \
    X(int, simGetStackPose, "simGetStackPose", (int a, double* b)) \
    X(int, simGetStackQuaternion, "simGetStackQuaternion", (int a, double* b)) \
    X(char*, simGetTableProperty, "simGetTableProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetTableProperty2, "simGetTableProperty2", (long long int a, const char* b, char** c, int* d)) \
    X(int, simImportMesh, "simImportMesh_D", (int a, const char* b, int c, double d, double e, void* f, void* g, void* h, void* i, void* j, void* k)) \
    X(int, simImportShape, "simImportShape_D", (int a, const char* b, int c, double d, double e)) \
    X(int, simInsertObjectIntoOctree, "simInsertObjectIntoOctree", (int a, int b, int c, const void* d, int e, const void* f)) \
    X(int, simInsertObjectIntoPointCloud, "simInsertObjectIntoPointCloud_D", (int a, int b, int c, double d, const void* e, const void* f)) \
    X(int, simInsertPointsIntoPointCloud, "simInsertPointsIntoPointCloud_D", (int a, int b, const void* c, int d, const void* e, const void* f)) \
    X(int, simInsertVoxelsIntoOctree, "simInsertVoxelsIntoOctree_D", (int a, int b, const void* c, int d, const void* e, const void* f, const void* g)) \
    X(int, simIntersectPointsWithPointCloud, "simIntersectPointsWithPointCloud_D", (int a, int b, const void* c, int d, double e, const void* f)) \
    X(int, simIsDeprecated, "simIsDeprecated", (const char* a)) \
    X(int, simIsRealTimeSimulationStepNeeded, "simIsRealTimeSimulationStepNeeded", (void)) \
    X(int, simPushColor4OntoStack, "simPushColor4OntoStack", (int a, const float* b)) \
    X(int, simPushPoseOntoStack, "simPushPoseOntoStack", (int a, const double* b)) \
    X(int, simPushQuaternionOntoStack, "simPushQuaternionOntoStack", (int a, const double* b)) \
    X(char*, simReadTexture, "simReadTexture", (int a, int b, int c, int d, int e, int f)) \
    X(int, simRefreshDialogs, "simRefreshDialogs", (int a)) \
    X(int, simRegisterScriptFuncHook, "simRegisterScriptFuncHook", (int a, const char* b, const char* c, int d, int e)) \
    X(int, simRemoveDrawingObject, "simRemoveDrawingObject", (int a)) \
    X(int, simRemovePointsFromPointCloud, "simRemovePointsFromPointCloud_D", (int a, int b, const void* c, int d, double e, const void* f)) \
    X(int, simRemoveVoxelsFromOctree, "simRemoveVoxelsFromOctree_D", (int a, int b, const void* c, int d, const void* e)) \
    X(int, simResetScript, "simResetScript", (int a)) \
    X(int, simRuckigPos, "simRuckigPos", (int a, double b, int c, const void* d, const void* e, const void* f, const void* g, const void* h, const void* i)) \
    X(int, simRuckigRemove, "simRuckigRemove", (int a)) \
    X(int, simRuckigStep, "simRuckigStep", (int a, double b, void* c, void* d, const void* e, const void* f)) \
    X(int, simRuckigVel, "simRuckigVel", (int a, double b, int c, const void* d, const void* e, const void* f, const void* g, const void* h, const void* i)) \
    X(int, simSaveImage, "simSaveImage", (const void* a, const int* b, int c, const char* d, int e, const void* f)) \
    X(int, simSetHandleArrayProperty, "simSetHandleArrayProperty", (long long int a, const char* b, const long long int* c, int nc)) \
    X(int, simSetHandleProperty, "simSetHandleProperty", (long long int a, const char* b, long long int c)) \
    X(int, simSetLightParameters, "simSetLightParameters", (int a, int b, const void* c, const float* d, const float* e)) \
    X(int, simSetModuleInfo, "simSetModuleInfo", (const char* a, int b, const char* c, int d)) \
    X(int, simSetNavigationMode, "simSetNavigationMode", (int a)) \
    X(int, simSetPage, "simSetPage", (int a)) \
    X(int, simSetReferencedHandles, "simSetReferencedHandles", (int a, int b, const void* c, const char* d, const void* e)) \
    X(int, simSetSimulationPassesPerRenderingPass, "simSetSimulationPassesPerRenderingPass", (int a)) \
    X(int, simSetTableProperty, "simSetTableProperty", (long long int a, const char* b, const char* c, int nc)) \
    X(int, simSetVisionSensorImg, "simSetVisionSensorImg", (int a, const void* b, int c, const int* d, const int* e)) \
    X(int, simTransformImage, "simTransformImage_D", (const void* a, const int* b, int c, const void* d, const void* e, const void* f)) \
    X(int, simWriteTexture, "simWriteTexture_D", (int a, int b, const void* c, int d, int e, int f, int g, double h))

#define SWANILDA_DECLARE(result, name, symbol, parameters) extern result (*name) parameters;
SWANILDA_FUNCTIONS(SWANILDA_DECLARE)

typedef void* LIBRARY;

/* Opens the library that simInit got the path of; NULL if that fails. */
LIBRARY loadSimLibrary(const char* path);
/* Finds all functions: 1, or 0 if one is missing and the environment has no COPPELIASIMPLUGIN_IGNORE_MISSING_SYMBOLS. */
int getSimProcAddresses(LIBRARY library);
void unloadSimLibrary(LIBRARY library);

#ifdef SWANILDA_PLUGIN_IMPLEMENTATION
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#define SWANILDA_DEFINE(result, name, symbol, parameters) result (*name) parameters = NULL;
SWANILDA_FUNCTIONS(SWANILDA_DEFINE)

LIBRARY loadSimLibrary(const char* path) { return dlopen(path, RTLD_LAZY); }

void unloadSimLibrary(LIBRARY library) {
    if (library) dlclose(library);
}

int getSimProcAddresses(LIBRARY library) {
    int complete = 1;
#define SWANILDA_FIND(result, name, symbol, parameters) \
    *(void**)(&name) = dlsym(library, symbol); \
    if (!name) { \
        fprintf(stderr, "Could not find function %s\n", symbol); \
        complete = 0; \
    }
    SWANILDA_FUNCTIONS(SWANILDA_FIND)
    return complete || getenv("COPPELIASIMPLUGIN_IGNORE_MISSING_SYMBOLS") != NULL;
}
#endif

#ifdef __cplusplus
}
#endif
#endif
