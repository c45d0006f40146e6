# Completion of drycut for bash.
_drycut() {
  local word="${COMP_WORDS[COMP_CWORD]}" words=""
  case "$COMP_CWORD:${COMP_WORDS[1]}" in
    1:*) COMPREPLY=($(compgen -W "run live replay check cam design tune sweep envelope size bode compare index convert devices plants new help --help --version" -- "$word")); return ;;
    2:devices) COMPREPLY=($(compgen -W "CAMMING4 EANPOS EPICPOS MODBUS OOPOS2 QMOVE CNF PLCOPEN AXIS ST MC_Power MC_Home MC_Reset MC_Stop MC_Halt MC_MoveAbsolute MC_MoveRelative MC_MoveAdditive MC_MoveSuperImposed MC_MoveVelocity MC_CamTableSelect MC_CamIn MC_CamOut MC_GearIn MC_GearOut MC_Phasing MC_SetPosition MC_SetOverride MC_ReadActualPosition MC_ReadActualVelocity MC_ReadStatus MC_ReadAxisError MC_ReadAxisInfo MC_ReadMotionState MC_ReadParameter MC_WriteParameter MC_TouchProbe MC_AbortTrigger CAM_TABLE_WRITE DECAM ECAMTBX LX3VP --json --help" -- "$word")); return ;;
    2:plants) COMPREPLY=($(compgen -W "backlash_axis bench flying_saw ideal_axis linear_axis rotary_knife vertical_press web --json --motors --motor-template --units --help" -- "$word")); return ;;
  esac
  case "${COMP_WORDS[1]}" in
    run) words="--help --out --jobs --seed --no-pictures --gltf --verify-step --strict --cache --summary --links --force --annotate --set --quiet --verbose" ;;
    live) words="--help --from --port --modbus --pace --paused --listen --opcua --record --set" ;;
    replay) words="--help --out --no-pictures --to-scenario --force" ;;
    check) words="--help --expand --set --annotate --strict --schema" ;;
    cam) words="--help --device --scene --master-speed --max-velocity --max-acceleration --at --csv --png --table --loops --force --strict" ;;
    design) words="--help --length --circumference --blades --feed --sync --thickness --speed --minimise --max-velocity --max-acceleration --max-travel --no-reverse --inertia --viscous --coulomb --device --table --scene --master-pulse --slave-pulse --decpt --force --out" ;;
    tune) words="--help --vary --minimise --constraint --wire --at --amplitude --from --ignore-checks --budget --jobs --seed --spread --spread-runs --on --stage --set --out --no-pictures" ;;
    sweep) words="--help --over --figure --jobs --on --stage --set --out --sample" ;;
    envelope) words="--help --over --figure --jobs --on --stage --set --out --find-max --find-min" ;;
    size) words="--help --drive --motors --gears --resistors --inertia-ratio --at --corners --jobs --on --stage --set --out" ;;
    bode) words="--help --wire --speed --at --from --to --points --amplitude --settle --limit-cycle --min-phase-margin --min-gain-margin --csv --png --force --out --set" ;;
    compare) words="--help --out --from --fail-on-difference --tolerance --without --align --no-pictures" ;;
    index) words="--help" ;;
    convert) words="--help --to --out --force" ;;
    devices) words="--help --json" ;;
    plants) words="--help --json --motors --motor-template --units" ;;
    new) words="--help --from --controller --list" ;;
    help) words="--help" ;;
  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}
complete -o filenames -F _drycut drycut
