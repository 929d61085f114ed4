target_sources(dynascope_core PRIVATE
    session/alarms.cpp session/alarms.h
    session/alarmwatch.cpp session/alarmwatch.h
    session/answerfaults.cpp session/answerfaults.h
    session/backup/backup.cpp session/backup/backup.h
    session/backup/backupcommands.cpp session/backup/backupcommands.h
    session/backup/backupfile.cpp
    session/backup/backupreader.cpp
    session/backup/comparebackups.cpp session/backup/comparebackups.h
    session/backup/restore.cpp session/backup/restore.h
    session/commands.cpp session/commands.h
    session/commissioning/bringin.cpp session/commissioning/bringin.h
    session/commissioning/commissioning.cpp session/commissioning/commissioning.h
    session/commissioning/commissionjournal.cpp session/commissioning/commissionjournal.h
    session/commissioning/commissionlist.cpp session/commissioning/commissionlist.h
    session/commissioning/commissionround.cpp session/commissioning/commissionround.h
    session/commissioning/fromprofile.cpp session/commissioning/fromprofile.h
    session/commissioning/identify.cpp session/commissioning/identify.h
    session/consequences.cpp session/consequences.h
    session/derived.cpp session/derived.h
    session/device.cpp session/device.h
    session/devicekeys.cpp session/devicekeys.h
    session/deviceplace.cpp session/deviceplace.h
    session/eventlog.cpp session/eventlog.h
    session/faultrecords.cpp session/faultrecords.h
    session/groupwrite.cpp session/groupwrite.h
    session/histories.cpp session/histories.h
    session/history.cpp session/history.h
    session/indirectfile.cpp session/indirectfile.h
    session/indirectpacking.cpp session/indirectpacking.h
    session/indirectkept.cpp session/indirectkept.h
    session/indirectreads.cpp session/indirectreads.h
    session/history/bits.h
    session/history/extremes.cpp session/history/extremes.h
    session/history/foldedhistory.cpp session/history/foldedhistory.h
    session/history/historymemory.cpp session/history/historymemory.h
    session/history/openchunk.h
    session/history/packedchunk.cpp session/history/packedchunk.h
    session/history/packedtimes.cpp session/history/packedtimes.h
    session/historymark.h
    session/journal/journal.cpp session/journal/journal.h
    session/journal/journalahead.cpp session/journal/journalahead.h
    session/journal/journalentry.cpp session/journal/journalentry.h
    session/journal/journalfile.cpp session/journal/journalfile.h
    session/journal/journalnote.cpp session/journal/journalnote.h
    session/journal/journaltexts.cpp session/journal/journaltexts.h
    session/journal/journalwrites.cpp session/journal/journalwrites.h
    session/journal/undo.cpp session/journal/undo.h
    session/journal/undoplan.cpp session/journal/undoplan.h
    session/journal/undostep.cpp
    session/journal/undosequence.cpp session/journal/undosequence.h
    session/linehealth.cpp session/linehealth.h
    session/linesession.cpp session/linesession.h
    session/monitor.cpp session/monitor.h
    session/moverun.cpp session/moverun.h
    session/moves.cpp session/moves.h
    session/neighbours.cpp session/neighbours.h
    session/packedreads.cpp session/packedreads.h
    session/placecommands.cpp
    session/pollforesight.cpp session/pollforesight.h
    session/procedures/atbaud.h
    session/procedures/changeplace.cpp
    session/procedures/movedevices.cpp session/procedures/movedevices.h
    session/procedures/movefile.cpp session/procedures/movefile.h
    session/procedures/moveplan.cpp session/procedures/moveplan.h session/procedures/moveplanfile.cpp
    session/procedures/procedures.cpp session/procedures/procedures.h
    session/procedures/revert.cpp session/procedures/revert.h
    session/profile/profile.cpp session/profile/profile.h session/profile/profilereader.cpp
    session/profile/profileapply.cpp session/profile/profileapply.h
    session/profile/profilecomparison.cpp session/profile/profilecomparison.h
    session/profile/profilefile.cpp
    session/profile/profilereading.cpp session/profile/profilereading.h
    session/profile/profilesave.cpp session/profile/profilesave.h
    session/profile/profilevalues.cpp session/profile/profilevalues.h
    session/profilerun.cpp session/profilerun.h
    session/profilesaver.cpp session/profilesaver.h
    session/ramguard.cpp session/ramguard.h
    session/rammarks.cpp session/rammarks.h
    session/reopener.cpp session/reopener.h
    session/resetplan.cpp session/resetplan.h
    session/restartsigns.cpp session/restartsigns.h
    session/scanner.cpp session/scanner.h
    session/session.cpp session/session.h
    session/settings/applysettings.cpp session/settings/applysettings.h
    session/settings/comparesettings.cpp
    session/settings/readimages.cpp session/settings/readimages.h
    session/settings/registerimage.h
    session/settings/settingsjournal.cpp session/settings/settingsjournal.h
    session/settings/settingsorder.cpp session/settings/settingsorder.h
    session/settings/settingsplan.cpp session/settings/settingsplan.h
    session/settingscommands.cpp session/settingscommands.h
    session/spanmeasure.cpp session/spanmeasure.h
    session/stopcontrol.cpp session/stopcontrol.h
    session/texts.h
    session/trigger.cpp session/trigger.h
    session/vitals.cpp session/vitals.h
    session/volatilespan.cpp session/volatilespan.h
    session/watch.h
    session/watchplan.cpp session/watchplan.h
)
